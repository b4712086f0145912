// What the page knows of the run: `data`, which is an argument of all this, as `before` is: what a reader saw of another
// run whose place this one takes, if there was one.
const { points, shapes, events, columns } = data;
const closing = new AbortController();  // for what listens beyond the parts of the page
const element = (id) => document.getElementById(id);
const svg = (name) => document.createElementNS('http://www.w3.org/2000/svg', name);
const round = (value, digits) => value === null ? '–' : String(Number(value.toPrecision(digits)));
const without_hyphens = (word) => word.replaceAll('-', ' ');

const events_at = new Map();  // of a point
for (const event of events) {
  if (!events_at.has(event.point)) events_at.set(event.point, []);
  events_at.get(event.point).push(event);
}

// Load factors as text; at events in no more digits than are sure.
const uncertain = new Map(data.uncertain);
const load_factor = (point, digits) => uncertain.get(point) ?? round(points.lambda[point], digits);

// Along all stages of a run: a stage goes on where the points of the one before end.
const through_stages = () => {
  const stage = (i) => data.stages[points.branch[i]], through = [];
  let begin = 0;
  points.arc.forEach((arc, i) => {
    if (i > 0 && stage(i) !== stage(i - 1)) begin = through[i - 1];
    through.push(begin + arc);
  });
  return through;
};

// What a point has to be drawn over, or under: λ, the monitors, and what every point has.
const quantities = [
  { key: 'lambda', name: 'λ', title: data.load_title, values: points.lambda },
  ...columns.map((column, i) => ({ key: column.name, name: column.name, title: column.title, values: points.monitors[i] })),
  { key: 'arc', name: 'arc length', title: 'arc length of the branch', values: points.arc },
  ...data.stages.length > 0 ? [{ key: 'arc of the run', name: 'arc length through the stages', title: 'arc length through the stages', values: through_stages() }] : [],
  { key: 'energy', name: 'energy', title: data.energy_unit === '' ? 'energy' : `energy [${data.energy_unit}]`, values: points.energy },
  { key: 'contacts', name: 'contacts', title: 'closed contacts', values: points.contacts },
  { key: 'unstable', name: 'unstable', title: 'unstable directions', values: points.unstable },
  { key: 'step', name: 'step', title: 'number of the point', values: points.step },
];
const load = quantities[0];
const first_across = columns.length > 0 ? quantities[1 + (data.moved ? data.force ?? 0 : 0)] : quantities.find(({ key }) => key === 'arc');
// Of a movement λ is the way: it is across, and a force up.
const first_axes = data.moved && columns.length > 0 && typeof Plotly !== 'undefined' ? { across: load, up: first_across } : { across: first_across, up: load };
