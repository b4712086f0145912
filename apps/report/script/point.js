// The point that is shown, in tables and in the picture of the shape.
const fill = (body, rows) => {
  body.replaceChildren(...rows.map((cells) => {
    const row = document.createElement('tr');
    cells.forEach((text, i) => {
      const cell = document.createElement(i === 0 ? 'th' : 'td');
      cell.textContent = text;
      if (i === cells.length - 1) cell.className = 'figure';
      row.append(cell);
    });
    return row;
  }));
};

const with_unit = (value, unit) => unit === '' ? value : `${value} ${unit}`;

const show_values = (point) => {
  fill(element('values').tBodies[0], [
    ['load factor λ', load_factor(point, 8)],
    ...columns.map((column, i) => [column.title, round(points.monitors[i][point], 7)]),
    ['stability', stability(point)],
    ['energy', with_unit(round(points.energy[point], 6), data.energy_unit)],
    ['branch, step', `${points.branch[point]}, ${points.step[point]}`],
  ]);
};

// The state after a jump, of which λ, the monitors and the energy are known.
const show_values_after = (jump) => {
  fill(element('values').tBodies[0], [
    ['load factor λ', load_factor(jump.point, 8)],
    ...columns.map((column, i) => [column.title, round(jump.to[i], 7)]),
    ['stability', 'stable'],
    ['energy', with_unit(round(jump.energy, 6), data.energy_unit)],
    ['branch, step', jump.behind === null ? 'off the branches' : `${points.branch[jump.behind]}, after ${points.step[jump.behind]}`],
  ]);
};

const most_rows = Math.min(shapes.reduce((most, { contacts }) => Math.max(most, contacts.length), 0), 6);
const show_shape = (shape) => {
  draw_stage(shape);
  const pressure_unit = data.force_unit && data.length_unit ? `${data.force_unit}/${data.length_unit}` : '';
  const friction = ([, , , , , state, T, p, use]) => (state === undefined ? ''
    : `, ${state}: T = ${round(T, 5)}, p = ${round(p, 5)}, |T|/μp = ${round(use, 4)}`);
  const force = (contact) => with_unit(round(contact[3], 5), data.force_unit) +
    (contact[4] === null ? '' : `, ${with_unit(round(contact[4], 5), pressure_unit)}`) + friction(contact);
  const most = 5;
  const contacts = [...shape.contacts].sort((a, b) => b[3] - a[3]);
  const rows = contacts.slice(0, most).map((contact) =>
    [contact[0], `${contact[1]}:${round(contact[2], 4)}`, force(contact)]);
  if (contacts.length > most) rows.push(['', `and ${contacts.length - most} more`, '']);
  element('touching').classList.toggle('none', rows.length === 0);
  while (rows.length > 0 && rows.length < most_rows) rows.push(['\u00a0', '', '']);  // so that the page stays where it is
  fill(element('touching').tBodies[0], rows);
};

// In the table's own window; the page stays where it is.
const show_row = (row) => {
  if (!row) return;
  const frame = row.closest('.scroll'), head = frame.querySelector('thead');
  const above = row.offsetTop - head.offsetHeight, below = row.offsetTop + row.offsetHeight;
  if (above < frame.scrollTop) frame.scrollTop = above;
  else if (below > frame.scrollTop + frame.clientHeight) frame.scrollTop = below - frame.clientHeight;
};

const mark_rows = (place) => {
  for (const marked of document.querySelectorAll('#events .here, #jumps .here, #strip .here')) marked.classList.remove('here');
  for (const one of document.querySelectorAll(`:is(#events, #jumps, #strip) [${place}]`)) one.classList.add('here');
  requestAnimationFrame(() => show_row(document.querySelector('#events .here, #jumps .here')));  // when the page is laid out
};
const show_event = (point) => {
  const said = (events_at.get(point) ?? []).map((event) =>
    without_hyphens(event.kind) + (event.what === '' ? '' : ` – ${event.what}`));
  element('happening').textContent = said.join('; ');
  mark_rows(`data-point="${point}"`);
};

let current = 0;  // shape
let jumped = null;  // the jump whose end is shown instead
let chart = null;
let show_forces = () => {};

const show = (index) => {
  current = Math.min(Math.max(index, 0), shapes.length - 1);
  jumped = null;
  const { point } = shapes[current];
  element('slider').value = current;
  element('slider').setAttribute('aria-valuetext', `λ = ${load_factor(point, 6)}, point ${point}`);
  show_shape(shapes[current]);
  show_forces(shapes[current]);
  show_values(point);
  show_event(point);
  chart.mark(point);
};

// Where the structure comes to rest; the slider stays at the event.
const show_jump = (number) => {
  const jump = data.jumps[number];
  show(shape_near(jump.point));
  jumped = number;
  show_shape(jump.shape);
  show_forces(jump.shape);
  show_values_after(jump);
  element('happening').textContent = `after the ${jump.returns ? 'return ' : ''}jump at λ = ${round(jump.lambda, 6)}: releases ` +
    with_unit(round(jump.released, 5), data.energy_unit);
  element('slider').setAttribute('aria-valuetext', element('happening').textContent);
  mark_rows(`data-jump="${number}"`);
  chart.mark(jump);
};
const shown_shape = () => jumped === null ? shapes[current] : data.jumps[jumped].shape;

// The shape of a point, or of the nearest point of its branch that has one.
const shape_near = (point) => {
  let nearest = 0, least = Infinity;
  shapes.forEach((shape, i) => {
    const other_branch = points.branch[shape.point] !== points.branch[point];
    const distance = Math.abs(shape.point - point) + (other_branch ? points.lambda.length : 0);
    if (distance < least) [nearest, least] = [i, distance];
  });
  return nearest;
};

const go_to = (point) => { stop(); show(shape_near(point)); };

const go_to_event = (direction) => {
  const ahead = [...events_at.keys()].sort((a, b) => direction * (a - b))
    .find((point) => direction * (point - shapes[current].point) > 0);
  if (ahead !== undefined) go_to(ahead);
};
