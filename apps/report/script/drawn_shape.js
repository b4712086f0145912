// The shape as it is drawn: which members, and how many times as large as they are their deflections.
// `M10 20l5-3 7 2`: the places of a path.
const places_of = (path) => {
  const numbers = (path.match(/-?\d+/g) ?? []).map(Number), places = [];
  for (let i = 0, x = 0, y = 0; i + 1 < numbers.length; i += 2) places.push([x += numbers[i], y += numbers[i + 1]]);
  return places;
};

let times = 1;
const hidden_members = new Set();
let place_named_points = () => {};

const is_hidden = (m) => hidden_members.has(m);
const hide_members = (members, hide) => { for (const m of members) hide ? hidden_members.add(m) : hidden_members.delete(m); };
const draw_deflections = (factor) => { times = factor; };

const drawn_places = (shape, m) => {
  const places = places_of(shape.paths[m]);
  if (times === 1) return places;
  const moves = places_of(shape.moves[m]), more = (times - 1) * data.move_unit;
  return places.map(([x, y], i) => [x + more * moves[i][0], y + more * moves[i][1]]);
};

const drawn_path = (shape, m) =>
  times === 1 ? shape.paths[m] : `M${drawn_places(shape, m).map((place) => place.map(Math.round).join(' ')).join('L')}`;

// What all shapes together take, as they are drawn: x, y, width, height.
const all_of_the_picture = () => {
  const [, , width, height] = element('stage').dataset.whole.split(' ').map(Number);
  let left = 0, top = 0, right = width, bottom = height;
  const margin = times === 1 ? 0 : 0.02 * Math.max(width, height);
  if (times !== 1)
    for (const shape of shapes)
      data.members.forEach((_, m) => {
        for (const [x, y] of drawn_places(shape, m)) {
          left = Math.min(left, x - margin);
          right = Math.max(right, x + margin);
          top = Math.min(top, y - margin);
          bottom = Math.max(bottom, y + margin);
        }
      });
  return [left, top, right - left, bottom - top];
};

// Of members alone: forces, loads, springs and touches have their places at the true shape, and are left out where the
// drawn one is another.
const draw_stage = (shape) => {
  for (const drawn of document.querySelectorAll('#shown [data-path]')) {
    const part = Number(drawn.dataset.path);
    drawn.setAttribute('d', part < data.members.length ? drawn_path(shape, part) : shape.paths[part]);
  }
  element('stage').classList.toggle('enlarged', times !== 1);
  element('enlarged-note').textContent = times === 1 ? ''
    : `Deflections are drawn ${times} times as large as they are, and gaps to walls are not: what is drawn inside a wall need not touch it. ` +
      'Loads, springs and contacts are left out.';
  place_named_points(shape);
};

// The members that are not hidden, in the shape and in the first shape behind it. A wall that some of them pass is light.
const show_members = () => {
  for (const drawn of document.querySelectorAll('#stage [data-path], #stage [data-member]')) {
    const m = Number(drawn.dataset.path ?? drawn.dataset.member);
    if (m < data.members.length) drawn.classList.toggle('hidden-member', is_hidden(m));
  }
  const shown = data.members.filter((_, m) => !is_hidden(m)).map(({ name }) => name);
  for (const part of ['surface', 'body'])
    document.querySelectorAll(`#stage #walls .${part}`).forEach((drawn, i) => {
      const { members } = data.walls[i];
      drawn.classList.toggle('light', members.length > 0 && shown.some((name) => !members.includes(name)));
    });
};
