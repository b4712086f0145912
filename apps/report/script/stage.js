// The picture of the shape: nearer, aside, names, which members, how large deflections are.
// Gives what says how large all of the picture is.
const nearer_and_aside = (stage) => {
  let whole = stage.getAttribute('viewBox').split(' ').map(Number), box = whole;
  const look_at = (next) => {
    const widest = whole[2], width = Math.min(Math.max(next[2], widest / 200), widest), height = width * whole[3] / whole[2];
    const inside = (at, size, from, all) => Math.min(Math.max(at, from), from + all - size);
    box = [inside(next[0], width, whole[0], whole[2]), inside(next[1], height, whole[1], whole[3]), width, height];
    if (width === widest) box = whole;
    stage.setAttribute('viewBox', box.map((number) => Math.round(number)).join(' '));
    stage.classList.toggle('near', width < widest);
  };
  const nearer = (times, x = box[0] + box[2] / 2, y = box[1] + box[3] / 2) =>
    look_at([x - (x - box[0]) / times, y - (y - box[1]) / times, box[2] / times]);
  const place = (at) => {
    const point = new DOMPoint(at.clientX, at.clientY).matrixTransform(stage.getScreenCTM().inverse());
    return [point.x, point.y];
  };
  stage.addEventListener('wheel', (turned) => {
    if (!turned.ctrlKey && !turned.metaKey && !stage.classList.contains('near')) return;  // the page scrolls
    turned.preventDefault();
    nearer(turned.deltaY < 0 ? 1.25 : 0.8, ...place(turned));
  }, { passive: false });
  let held = null;
  stage.addEventListener('pointerdown', (pressed) => {
    if (!stage.classList.contains('near')) return;
    held = place(pressed);
    stage.setPointerCapture(pressed.pointerId);
  });
  stage.addEventListener('pointermove', (moved) => {
    if (held === null) return;
    const [x, y] = place(moved);
    look_at([box[0] + held[0] - x, box[1] + held[1] - y, box[2]]);
  });
  for (const name of ['pointerup', 'pointercancel']) stage.addEventListener(name, () => { held = null; });
  stage.addEventListener('dblclick', () => look_at(whole));
  element('nearer').addEventListener('click', () => nearer(1.5));
  element('farther').addEventListener('click', () => nearer(1 / 1.5));
  element('whole').addEventListener('click', () => look_at(whole));
  return (all) => {
    const is_whole = box === whole;
    whole = all;
    look_at(is_whole ? whole : box);
  };
};

// A title is what browsers show where the pointer rests.
const name_part = (part, text) => {
  const title = svg('title');
  title.textContent = text;
  part.append(title);
};

// The deck's points at the ends of the members: each once, seen where the pointer is.
const name_points = () => {
  const most = 2000, named = new Map();
  data.members.forEach(({ from, to }, m) => {
    if (!named.has(from)) named.set(from, [m, 0]);
    if (!named.has(to)) named.set(to, [m, -1]);
  });
  if (named.size > most) return () => {};
  const marks = [...named].map(([name, [m, end]]) => {
    const mark = svg('path');
    mark.setAttribute('class', 'named-point');
    name_part(mark, `point ${name}`);
    return { mark, m, end };
  });
  element('named-points').replaceChildren(...marks.map(({ mark }) => mark));
  return (shape) => {
    for (const { mark, m, end } of marks) {
      const place = drawn_places(shape, m).at(end);
      mark.setAttribute('d', place ? `M${place.map(Math.round).join(' ')}h0` : '');
      mark.classList.toggle('hidden-member', is_hidden(m));
    }
  };
};

// Which place of which member is under the pointer, and what it carries there.
const say_what_is_pointed_at = (stage) => {
  const pointed = element('pointed');
  const nearest_to = ({ x, y }, reach) => {
    let found = null, least = reach;
    data.members.forEach((_, m) => {
      if (is_hidden(m)) return;
      drawn_places(shown_shape(), m).forEach(([px, py], index) => {
        const distance = Math.hypot(px - x, py - y);
        if (distance < least) [found, least] = [{ m, index }, distance];
      });
    });
    return found;
  };
  const carried = (m, index) => {
    const samples = shown_shape().forces[m] ?? [];
    const nearest = samples.reduce((best, sample) => best && Math.abs(best[0] - index) <= Math.abs(sample[0] - index) ? best : sample, null);
    if (!nearest) return '';
    const [, fraction, n, q, moment] = nearest;
    return ` at ${round(fraction, 3)} of its length: N = ${with_unit(round(n, 4), data.force_unit)}, Q = ${with_unit(round(q, 4), data.force_unit)}, ` +
      `M = ${with_unit(round(moment, 4), moment_unit)}`;
  };
  stage.addEventListener('pointermove', (moved) => {
    const matrix = stage.getScreenCTM().inverse(), pixels = 20;
    const found = nearest_to(new DOMPoint(moved.clientX, moved.clientY).matrixTransform(matrix), pixels * matrix.a);
    pointed.textContent = found ? `Member ${data.members[found.m].name}${carried(found.m, found.index)}` : '';
  });
  stage.addEventListener('pointerleave', () => { pointed.textContent = ''; });
};

const round_factors = (most) => {
  const factors = [];
  for (let decade = 1; decade <= most; decade *= 10)
    for (const part of [1, 2, 5]) if (part * decade <= most) factors.push(part * decade);
  return factors;
};

// Deflections that fill the picture as they are, or are none, have no other scale.
const scale_choice = (set_whole, redraw) => {
  const choice = element('times'), longer = 1e5, widest = 0.5;
  if (!data.move_unit) {
    choice.closest('label').remove();
    return;
  }
  for (const factor of round_factors(widest * longer / data.greatest_move)) choice.append(new Option(String(factor)));
  choice.addEventListener('change', () => {
    draw_deflections(Number(choice.value));
    set_whole(all_of_the_picture());
    redraw();
  });
};

const member_choice = (redraw) => {
  if (data.members.length < 2) {
    element('members-shown').remove();
    return;
  }
  const most = 200, part = element('part-of-name'), list = element('member-list');
  const those_named = () => data.members.map(({ name }, m) => ({ name, m })).filter(({ name }) => name.includes(part.value));
  const redraw_all = () => {
    const hidden = data.members.filter((_, m) => is_hidden(m)).length;
    element('members-hidden').textContent = hidden === 0 ? 'all' : `${data.members.length - hidden} of ${data.members.length}`;
    show_members();
    redraw();
  };
  const fill_list = () => {
    const named = those_named();
    list.replaceChildren(...named.slice(0, most).map(({ name, m }) => {
      const label = document.createElement('label'), box = document.createElement('input');
      box.type = 'checkbox';
      box.checked = !is_hidden(m);
      box.addEventListener('change', () => { hide_members([m], !box.checked); redraw_all(); });
      label.append(box, ` ${name}`);
      return label;
    }));
    if (named.length > most) list.append(`and ${named.length - most} more, for which a part of the name can be given`);
  };
  const all = (hide) => () => {
    hide_members(those_named().map(({ m }) => m), hide);
    fill_list();
    redraw_all();
  };
  part.addEventListener('input', fill_list);
  element('show-members').addEventListener('click', all(false));
  element('hide-members').addEventListener('click', all(true));
  fill_list();
};

const shape_tools = () => {
  const stage = element('stage');
  const set_whole = nearer_and_aside(stage);
  const redraw = () => {
    show_shape(shown_shape());
    show_forces(shown_shape());
  };
  element('shape-svg').addEventListener('click', () => save(as_blob(picture_alone(stage)), 'shape.svg'));
  element('shape-png').addEventListener('click', () => save_png(picture_alone(stage), 'shape.png'));
  element('table-csv').addEventListener('click', () => save(new Blob([csv()], { type: 'text/csv' }), 'points.csv'));
  if (typeof Plotly === 'undefined') element('curve-svg').remove();
  else element('curve-svg').addEventListener('click', () => Plotly.downloadImage(element('plot'), { format: 'svg', filename: 'curve', width: 900, height: 600 }));
  element('animation').addEventListener('click', () => save_animation(stage));
  for (const part of document.querySelectorAll('#shown [data-path]')) {
    const member = data.members[Number(part.dataset.path)];
    if (member) name_part(part, `member ${member.name}`);
  }
  document.querySelectorAll('#walls .body').forEach((part, i) => {
    const { name, members } = data.walls[i];
    name_part(part, `wall ${name}${members.length > 0 ? `, for ${members.join(', ')}` : ''}`);
  });
  place_named_points = name_points();
  say_what_is_pointed_at(stage);
  scale_choice(set_whole, redraw);
  member_choice(redraw);
};
