// The page of a sweep: a load of its cases over the keys that vary. No case is averaged with another.
const show_sweep = (data) => {
const { keys, loads, cases, curves } = data;
const element = (id) => document.getElementById(id);
const made = (name, properties = {}, ...children) => {
  const one = Object.assign(document.createElement(name), properties);
  one.append(...children);
  return one;
};
const has_plots = typeof Plotly !== 'undefined';
const all = cases.number.map((_, i) => i);
const short = (value) => typeof value === 'number' ? String(Number(value.toPrecision(6))) : value;
const value_of = (i, k) => cases.values[k][i];
const load_of = (i) => cases.loads[chosen.load][i];
const with_unit = (value, unit) => unit === '' ? short(value) : `${short(value)} ${unit}`;
const distinct = keys.map((_, k) => {
  const once = [...new Set(cases.values[k])];
  return once.every((value) => typeof value === 'number') ? once.sort((a, b) => a - b) : once;
});
const ranks = distinct.map((values) => new Map(values.map((value, rank) => [value, rank])));
const rank_of = (i, k) => ranks[k].get(value_of(i, k));
const has_numbers = (k) => typeof distinct[k][0] === 'number';
const grouped = (some, name) => {
  const groups = new Map();
  for (const i of some) {
    const key = name(i);
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push(i);
  }
  return groups;
};
const place = (i) => `${value_of(i, chosen.across)}\n${value_of(i, chosen.up)}`;

// What the reader has chosen: a load, the keys of both axes (`up` is null with one key), values of the other keys, a case.
const any = '';
const chosen = { load: 0, across: 0, up: keys.length > 1 ? 1 : null, fixed: new Map(), measure: 'load', case: null };
const others = () => keys.map((_, k) => k).filter((k) => k !== chosen.across && k !== chosen.up);
const drawn = () => all.filter((i) => others().every((k) => !chosen.fixed.has(k) || value_of(i, k) === chosen.fixed.get(k)));
// Where several cases lie at one place, the other keys part them.
const fix_others = () => {
  chosen.fixed.clear();
  if (chosen.up === null || grouped(all, place).size === all.length) return;
  for (const k of others()) chosen.fixed.set(k, distinct[k][0]);
};

// --- cases -----------------------------------------------------------------------------------------------------------

const describe = (i) => [`case ${cases.number[i]}`,
  ...keys.map(({ name, unit }, k) => `${name} = ${with_unit(value_of(i, k), unit)}`),
  load_of(i) === null ? 'no such event' : `${loads[chosen.load].title} is ${with_unit(load_of(i), loads[chosen.load].unit)}`,
  ...cases.failed[i] === '' ? [] : [`failed: ${cases.failed[i]}`],
  ...cases.report[i] === 'page' ? ['a click opens its report'] : []];
const hover_text = (i) => describe(i).map(as_text).join('<br>');
const folder_of = (i) => `cases/${String(cases.number[i]).padStart(5, '0')}`;
const choose_case = (i) => {
  chosen.case = i;
  element('case').textContent = describe(i).filter((line) => !line.startsWith('a click')).join(', ') +
    (cases.report[i] === 'page' ? '. Enter opens its report.' : cases.report[i] === 'folder' ? `. trace-path report ${folder_of(i)} writes its report.` : '.');
  for (const plot of [element('map'), element('lines')]) ring(plot);
};
const open_case = (i) => {
  choose_case(i);
  if (cases.report[i] === 'page') window.location.href = `${folder_of(i)}/report.html`;
};

// --- plots -----------------------------------------------------------------------------------------------------------

const viridis = [[59, 82, 139], [44, 114, 142], [33, 145, 140], [40, 174, 128], [94, 201, 98]];
const colour_at = (part) => {
  const at = part * (viridis.length - 1), i = Math.min(Math.floor(at), viridis.length - 2);
  return `rgb(${viridis[i].map((value, c) => Math.round(value + (at - i) * (viridis[i + 1][c] - value))).join()})`;
};
const axis_of = (k) => {
  const title = keys[k].unit === '' ? keys[k].name : `${keys[k].name} [${keys[k].unit}]`, values = distinct[k], few = 10;
  if (!has_numbers(k)) return { ...plot_axis(title), type: 'category', categoryarray: values.map(as_text) };
  const is_logarithmic = values[0] > 0 && values.at(-1) >= 10 * values[0];
  return { ...plot_axis(title), type: is_logarithmic ? 'log' : 'linear',
    ...values.length <= few ? { tickmode: 'array', tickvals: values, ticktext: values.map(short) } : {} };
};
const at_axis = (i, k) => has_numbers(k) ? value_of(i, k) : as_text(value_of(i, k));
const load_title = () => loads[chosen.load].axis;

// The case that was chosen, as the last trace of a plot.
const ring_trace = (plot) => {
  const at = chosen.case === null ? undefined : plot.places?.get(chosen.case);
  return { type: 'scatter', mode: 'markers', hoverinfo: 'skip', showlegend: false, x: at ? [at[0]] : [null], y: at ? [at[1]] : [null],
    marker: { size: 20, symbol: 'circle-open', color: colour('force'), line: { width: 3 } } };
};
const ring = (plot) => {
  if (!plot.data?.length) return;
  const { x, y } = ring_trace(plot);
  Plotly.restyle(plot, { x: [x], y: [y] }, [plot.data.length - 1]);
};
const draw = (plot, traces, layout, places) => {
  plot.places = places;
  Plotly.react(plot, [...traces, ring_trace(plot)], { ...layout, legend: { ...layout.legend, orientation: 'h', y: -0.25, yanchor: 'top' } },
    { ...plot_config, modeBarButtons: [[...plot_buttons, 'resetScale2d']] });
  if (plot.case_of === undefined)
    plot.on('plotly_click', ({ points: [point] }) => {
      const i = plot.case_of(point);
      if (Number.isInteger(i)) open_case(i);
    });
  plot.case_of = ({ customdata }) => customdata;
};
const symbol_of = (i) => cases.failed[i] !== '' ? 'x' : load_of(i) === null ? 'circle-open' : 'circle';

const cell_traces = (some, x, y, at) => {
  const cell = (row, column) => at.get(`${x[column]}\n${y[row]}`)[0];
  const table = (value) => y.map((_, row) => x.map((_, column) => value(cell(row, column))));
  const many = 100, least = 4;
  const common = { x: x.map((value) => typeof value === 'number' ? value : as_text(value)), y: y.map((value) => typeof value === 'number' ? value : as_text(value)) };
  const traces = [{ type: 'heatmap', ...common, z: table(load_of), text: table(hover_text), hoverinfo: 'text', hoverongaps: true, xgap: 1, ygap: 1,
    colorscale: 'Viridis', colorbar: { title: { text: as_text(load_title()), side: 'right' } },
    ...some.length <= many ? { texttemplate: '%{z:.4g}' } : {} }];
  if ([x, y].every((values) => values.length >= least && typeof values[0] === 'number'))
    traces.push({ type: 'contour', ...common, z: table((i) => cases.failed[i] === '' ? load_of(i) : null), hoverinfo: 'skip', showscale: false,
      contours: { coloring: 'none' }, line: { color: '#000', width: 1, smoothing: 0 } });
  return traces;
};

const draw_map = (some) => {
  const { across, up } = chosen;
  const at = grouped(some, place);
  const [x, y] = [across, up].map((k) => {
    const there = new Set(some.map((i) => value_of(i, k)));
    return distinct[k].filter((value) => there.has(value));
  });
  const is_grid = x.length > 1 && y.length > 1 && at.size === some.length && x.length * y.length === some.length;
  const marked = (those, marker) => ({ type: 'scatter', mode: 'markers', x: those.map((i) => at_axis(i, across)), y: those.map((i) => at_axis(i, up)),
    customdata: those, hovertext: those.map(hover_text), hoverinfo: 'text', marker });
  const odd = some.filter((i) => symbol_of(i) !== 'circle'), even = some.filter((i) => symbol_of(i) === 'circle');
  const odd_ones = marked(odd, { size: 11, symbol: odd.map(symbol_of), color: colour('force'), line: { width: 1.5, color: colour('force') } });
  const traces = is_grid ? [...cell_traces(some, x, y, at), odd_ones] : [marked(even, { size: 10, color: even.map(load_of), colorscale: 'Viridis', showscale: true,
    line: { width: 0.5, color: colour('ink') }, colorbar: { title: { text: as_text(load_title()), side: 'right' } } }), odd_ones];
  draw(element('map'), traces, plot_layout(axis_of(across), axis_of(up)), new Map(some.map((i) => [i, [at_axis(i, across), at_axis(i, up)]])));
  if (is_grid)
    element('map').case_of = ({ customdata, pointNumber }) => Array.isArray(pointNumber) ? at.get(`${x[pointNumber[1]]}\n${y[pointNumber[0]]}`)[0] : customdata;
  return some.length - at.size;
};

// λ₀ of a line: the load of the case whose key is nearest to 0, of texts the first.
const reference = (line, k) => {
  const first = has_numbers(k) ? line.reduce((a, b) => Math.abs(value_of(b, k)) < Math.abs(value_of(a, k)) ? b : a) : line[0];
  return cases.failed[first] === '' && load_of(first) !== 0 ? load_of(first) : null;
};
// A legend has the keys as its title, so that a narrow one keeps the values.
const values_in = (of, i) => as_text(of.map((k) => with_unit(value_of(i, k), keys[k].unit)).join(', '));
const legend_of = (of) => ({ title: { text: as_text(of.map((k) => keys[k].name).join(', ')), side: 'top', font: { size: 12 } } });
const draw_lines = (some) => {
  const k = chosen.across, is_part = chosen.measure === 'part';
  const rest = keys.map((_, other) => other).filter((other) => other !== k);
  const lines = [...grouped(some, (i) => JSON.stringify(rest.map((other) => value_of(i, other)))).values()];
  for (const line of lines) line.sort((a, b) => rank_of(a, k) - rank_of(b, k));
  const most = 12, bins = Math.min(lines.length, most), height = new Map();
  const traces = Array.from({ length: bins }, (_, bin) => ({ type: 'scatter', mode: 'lines', hoverinfo: 'skip', x: [], y: [], connectgaps: false,
    line: { width: 2, color: colour_at(bins > 1 ? bin / (bins - 1) : 0.4) }, showlegend: lines.length > 1 && lines.length <= most }));
  lines.forEach((line, l) => {
    const trace = traces[Math.floor(l * bins / lines.length)], unit = is_part ? reference(line, k) : 1;
    trace.name = values_in(rest, line[0]);
    for (const i of line) {
      height.set(i, load_of(i) === null || unit === null ? null : load_of(i) / unit);
      trace.x.push(at_axis(i, k));
      trace.y.push(cases.failed[i] === '' ? height.get(i) : null);
    }
    trace.x.push(null);
    trace.y.push(null);
  });
  const seen = some.filter((i) => height.get(i) !== null);
  traces.push({ type: 'scatter', mode: 'markers', x: seen.map((i) => at_axis(i, k)), y: seen.map((i) => height.get(i)), customdata: seen, showlegend: false,
    hovertext: seen.map((i) => hover_text(i) + (is_part ? `<br>${short(height.get(i))} of λ₀` : '')), hoverinfo: 'text',
    marker: { size: 7, symbol: seen.map(symbol_of), color: colour('ink') } });
  const up = plot_axis(is_part ? `part of λ₀, ${loads[chosen.load].title}` : load_title());
  draw(element('lines'), traces, { ...plot_layout(axis_of(k), up), showlegend: lines.length > 1 && lines.length <= most, legend: legend_of(rest) },
    new Map(seen.map((i) => [i, [at_axis(i, k), height.get(i)]])));
  element('line-key').textContent = keys[k].name;
};

const draw_curves = () => {
  const all = keys.map((_, k) => k);
  const traces = curves.lines.map(({ index, x, y }, c) => ({ type: 'scatter', mode: 'lines+markers', x, y, customdata: x.map(() => index),
    hovertext: x.map((value, p) => `${hover_text(index)}<br>${as_text(curves.across)}: ${value}, λ = ${y[p]}`), hoverinfo: 'text', marker: { size: 4 },
    line: { width: 2, color: colour_at(curves.lines.length > 1 ? c / (curves.lines.length - 1) : 0.4) },
    name: values_in(all, index) }));
  draw(element('curves'), traces, { ...plot_layout(plot_axis(curves.across), plot_axis(curves.up)), showlegend: traces.length > 1 && traces.length <= 12, legend: legend_of(all) }, new Map());
  element('curves-note').textContent = curves.lines.length < curves.count ? `${curves.lines.length} of ${curves.count} curves are drawn; curves.csv has all.` : '';
};

// --- the page --------------------------------------------------------------------------------------------------------

const fill_table = (some) => {
  const most = 200, table = element('cases');
  const cell = (text, is_number = true) => made('td', { className: is_number ? 'figure' : '', textContent: text });
  const titles = ['case', ...keys.map(({ name, unit }) => unit === '' ? name : `${name} [${unit}]`), ...loads.map(({ axis }) => axis), 'failed'];
  table.tHead.replaceChildren(made('tr', {}, ...titles.map((textContent) => made('th', { textContent, scope: 'col' }))));
  table.tBodies[0].replaceChildren(...some.slice(0, most).map((i) => made('tr', {},
    cases.report[i] === 'page' ? made('td', {}, made('a', { href: `${folder_of(i)}/report.html`, textContent: cases.number[i] })) : cell(cases.number[i]),
    ...keys.map((_, k) => cell(short(value_of(i, k)), has_numbers(k))), ...loads.map((_, l) => cell(short(cases.loads[l][i] ?? ''))), cell(cases.failed[i], false))));
  if (some.length > most) table.tBodies[0].append(made('tr', {}, made('td', { colSpan: titles.length, textContent: `and ${some.length - most} more; cases.csv has all` })));
};
const show = () => {
  const some = drawn(), notes = [];
  element('map-view').hidden = chosen.up === null;
  if (has_plots) {
    const hidden = chosen.up === null ? 0 : draw_map(some);
    draw_lines(some);
    if (hidden > 0) notes.push(`On the map ${hidden} cases lie behind others at the same place: choose values of the other keys.`);
  }
  if (data.ran > all.length) notes.push(`${all.length} of ${data.ran} cases are drawn, each as it is, spread evenly over their numbers; cases.csv has all.`);
  element('drawn-note').textContent = notes.join(' ');
  if (element('table-view').open) fill_table(some);
};
const show_others = () => {
  const most = 40;
  element('others').replaceChildren(...others().filter((k) => distinct[k].length > 1).map((k) => {
    const select = made('select', {}, new Option('any', any), ...distinct[k].length > most ? [] : distinct[k].map((value) => new Option(with_unit(value, keys[k].unit), JSON.stringify(value))));
    select.value = chosen.fixed.has(k) ? JSON.stringify(chosen.fixed.get(k)) : any;
    select.addEventListener('change', () => {
      if (select.value === any) chosen.fixed.delete(k);
      else chosen.fixed.set(k, JSON.parse(select.value));
      show();
    });
    return made('label', {}, `${keys[k].name} `, select);
  }));
};
const offer = (id, names, value, choose) => {
  const select = element(id);
  select.replaceChildren(...names.map((name, i) => new Option(name, i)));
  select.value = value;
  select.addEventListener('change', () => choose(Number(select.value)));
};
const choose_key = (which, other) => (k) => {
  if (chosen[other] === k) chosen[other] = chosen[which];
  chosen[which] = k;
  [element('across').value, element('up').value] = [chosen.across, chosen.up];
  fix_others();
  show_others();
  show();
};

document.documentElement.classList.add('js');
element('curves-panel').hidden = curves.lines.length === 0 || !has_plots;
element('loads-panel').hidden = loads.length === 0 || all.length === 0;
const names = keys.map(({ name }) => name);
offer('load', loads.map(({ title }) => title), 0, (load) => { chosen.load = load; show(); });
offer('across', names, chosen.across, choose_key('across', 'up'));
offer('up', names, chosen.up, choose_key('up', 'across'));
element('up-label').hidden = chosen.up === null;
element('measure').addEventListener('change', (changed) => { chosen.measure = changed.target.value; show(); });
element('table-view').addEventListener('toggle', show);
for (const id of ['map', 'lines'])
  element(id).addEventListener('keydown', (pressed) => {
    const some = drawn(), at = some.indexOf(chosen.case);
    const next = { ArrowRight: at + 1, ArrowDown: at + 1, ArrowLeft: at - 1, ArrowUp: at - 1, Home: 0, End: some.length - 1 }[pressed.key];
    if (pressed.key === 'Enter' && at >= 0) open_case(some[at]);
    if (next === undefined) return;
    pressed.preventDefault();
    if (some[next] !== undefined) choose_case(some[next]);
  });
const show_all = () => {
  if (!element('loads-panel').hidden) show();
  if (!element('curves-panel').hidden) draw_curves();
};
fix_others();
show_others();
show_all();
window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', show_all);
};
