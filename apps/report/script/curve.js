// The curve as plotly draws it: what is drawn, and where.
const of_branch = (own) => own === '#000000' ? colour('ink') : own;

const stability = (point) => {
  const unstable = points.unstable[point];
  const is_singular = ({ kind }) => kind === 'limit-point' || kind === 'branch-point';
  if (points.stability[point] === 'undecided' && (events_at.get(point) ?? []).some(is_singular)) return 'critical (tangent stiffness singular)';
  return points.stability[point] + (unstable > 0 ? ` in ${unstable} direction${unstable > 1 ? 's' : ''}` : '');
};

const describe = (point) => {
  const said = (events_at.get(point) ?? []).map((event) => `${without_hyphens(event.kind)} ${event.what}`.trim());
  const values = columns.map((column, i) => `${column.name} = ${round(points.monitors[i][point], 6)}`);
  return [...said, `λ = ${load_factor(point, 8)}`, ...values,
    stability(point),
    `branch ${points.branch[point]}, step ${points.step[point]}`];
};
const hover_text = (point) => describe(point).map(as_text).join('<br>');

// One trace for all lines of a branch with the same stability; gaps part them. A last one, which is not seen, has the
// points: what they say, and what a click selects.
const line_traces = ({ across, up }) => {
  const traces = new Map();
  const dashes = { stable: 'solid', unstable: 'dash', undecided: 'dot' };
  const sizes = sizes_of(across.values, up.values);
  for (const line of data.lines) {
    const key = `${line.branch} ${line.stability}`;
    if (!traces.has(key)) {
      traces.set(key, { type: 'scatter', mode: 'lines', x: [], y: [], hoverinfo: 'skip', connectgaps: false,
        line: { color: of_branch(line.colour), width: 2.2, dash: dashes[line.stability] } });
    }
    const trace = traces.get(key), { x, y } = drawn_curve(path_curve, across.key, up.key, sizes, line.first, line.last);
    trace.x.push(...x, null);
    trace.y.push(...y, null);
  }
  const all = points.lambda.map((_, i) => i);
  return [...traces.values(), { type: 'scatter', mode: 'lines', x: across.values, y: up.values, customdata: all,
    hovertext: all.map(hover_text), hoverinfo: 'text', line: { width: 0 } }];
};

// What a quantity is in a state of which λ, the monitors and the energy are known; undefined of others.
const in_state = (quantity, lambda, monitors, energy) => quantity === load ? lambda : quantity.key === 'energy' ? energy
  : monitors[columns.findIndex(({ name }) => name === quantity.key)];

// Where the structure jumps to from a loss of stability, at constant λ.
const jump_arrows = ({ across, up }) => {
  const ends = data.jumps.map((jump) => [[jump.from, jump.energy + jump.released], [jump.to, jump.energy]].map(([monitors, energy]) =>
    [across, up].map((quantity) => in_state(quantity, jump.lambda, monitors, energy) ?? null)));
  const known = ends.filter((both) => both.flat().every((value) => value !== null));
  const of_all = (values) => known.flatMap((both) => [...values(both), null]);
  return { type: 'scatter', mode: 'lines+markers', hoverinfo: 'skip', connectgaps: false,
    x: of_all((both) => both.map(([x]) => x)), y: of_all((both) => both.map(([, y]) => y)), line: { color: colour('force'), width: 2 },
    marker: { symbol: 'arrow', angleref: 'previous', opacity: 1, color: colour('force'), size: known.flatMap(() => [0, 12, 0]), line: { width: 0 } } };
};

// Where the events are, if the rest of the curve would leave them a small part of the picture; else null. It goes from
// the start to the last event of each branch that has one.
const view_of_events = ({ across, up }) => {
  const last = new Map();
  for (const event of events)
    if (event.kind !== 'start' && event.kind !== 'end') last.set(points.branch[event.point], event.point);
  if (last.size === 0) return null;
  const seen = (i) => i <= (last.get(points.branch[i]) ?? -1);
  const range = (values, is_in) => range_of(values.filter((_, i) => is_in(i)));
  const ranges = [across.values, up.values].map((values) => [range(values, seen), range(values, () => true)]);
  const small = 0.1;
  const width = ([low, high]) => high - low;
  if (!ranges.some(([near, all]) => width(near) < small * width(all))) return null;
  return ranges.map(([near, all]) => {
    const margin = 0.12 * (width(near) || width(all) || 1);
    return [near[0] - margin, near[1] + margin];
  });
};

// Marks of hundreds of changes of contact would cover each other and the curve: of those that stand closer than their
// size one is drawn. Other events always are.
// `sizes`: gives those of the picture in pixels, for which a browser lays out the page.
const drawn_events = ({ across, up }, view, sizes) => {
  const few = 40;
  const is_contact = ({ kind }) => /^contact(-(closes|opens|spreads|splits|shrinks|transfers)|s-merge)$/.test(kind);
  if (events.filter(is_contact).length <= few) return events;
  const size = sizes();
  const [x, y] = [[across.values, view[0], size[0]], [up.values, view[1], size[1]]].map(([values, [low, high], pixels]) =>
    (point) => (values[point] - low) / (high - low || 1) * pixels);
  const least = 13;
  const cells = new Map();
  const is_free = (event) => {
    const [column, row] = [x(event.point), y(event.point)].map((place) => Math.floor(place / least));
    for (let i = column - 1; i <= column + 1; ++i)
      for (let j = row - 1; j <= row + 1; ++j) {
        const near = cells.get(`${i} ${j}`);
        if (near && Math.hypot(x(near.point) - x(event.point), y(near.point) - y(event.point)) < least) return false;
      }
    cells.set(`${column} ${row}`, event);
    return true;
  };
  return events.filter((event) => !is_contact(event) || is_free(event));
};

const event_trace = ({ across, up }, drawn) => {
  const marked = [...drawn].sort((a, b) => b.size - a.size);  // a small mark stands on a large one
  return {
    type: 'scatter', mode: 'markers', hoverinfo: 'text',
    x: marked.map((event) => across.values[event.point]),
    y: marked.map((event) => up.values[event.point]),
    customdata: marked.map((event) => event.point),
    hovertext: marked.map((event) => hover_text(event.point)),
    marker: { opacity: 1, size: marked.map((event) => event.size), symbol: marked.map((event) => event.symbol),
      color: marked.map((event) => event.filled ? colour('ink') : colour('paper')), line: { color: colour('ink'), width: 1.4 } },
  };
};

// Other runs and measured points, where they have both quantities. Of a run a second trace has the points: marks that are not
// seen, for which plotly leaves room at the edge of the picture.
const overlay_traces = ({ across, up }) => data.overlays.filter(({ values }) => values[across.key] && values[up.key]).flatMap((other) => {
  const { [across.key]: x, [up.key]: y } = other.values;
  const named = { type: 'scatter', x, y, hoverinfo: 'text',
    hovertext: y.map((value, i) => as_text(`${other.name}: ${up.name} = ${round(value, 8)}, ${across.name} = ${round(x[i], 8)}`)) };
  if (other.measured) return [{ ...named, mode: 'markers', marker: { color: other.colour, size: 7, symbol: 'x-thin', line: { color: other.colour, width: 1.6 } } }];
  const sizes = sizes_of(across.values, up.values), drawn = { x: [], y: [] };
  other.firsts.forEach((first, b) => {
    const part = drawn_curve(other, across.key, up.key, sizes, first, (other.firsts[b + 1] ?? x.length) - 1);
    drawn.x.push(...part.x, null);
    drawn.y.push(...part.y, null);
  });
  return [{ ...named, mode: 'markers', marker: { opacity: 0, size: 12, maxdisplayed: 1 } },
    { type: 'scatter', mode: 'lines', hoverinfo: 'skip', connectgaps: false, ...drawn, line: { color: other.colour, width: 1.6 } }];
});
