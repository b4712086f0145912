'use strict';
(() => {
  const data = JSON.parse(document.getElementById('data').textContent);
  const { points, shapes, events, columns } = data;
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

  // What a point has to be drawn over, or under: λ, the monitors, and what every point has.
  const quantities = [
    { key: 'lambda', name: 'λ', title: data.load_title, values: points.lambda },
    ...columns.map((column, i) => ({ key: column.name, name: column.name, title: column.title, values: points.monitors[i] })),
    { key: 'arc', name: 'arc length', title: 'arc length of the branch', values: points.arc },
    { key: 'energy', name: 'energy', title: data.energy_unit === '' ? 'energy' : `energy [${data.energy_unit}]`, values: points.energy },
    { key: 'contacts', name: 'contacts', title: 'closed contacts', values: points.contacts },
    { key: 'unstable', name: 'unstable', title: 'unstable directions', values: points.unstable },
    { key: 'step', name: 'step', title: 'step of the branch', values: points.step },
  ];
  const load = quantities[0];
  const first_across = columns.length > 0 ? quantities[1] : quantities.find(({ key }) => key === 'arc');

  // --- the chart: plotly's where the page carries it, else the pictures of the page ----------------------------------

  // Colours of the page, which follow whether it is light or dark.
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  const of_branch = (own) => own === '#000000' ? colour('ink') : own;

  // plotly reads <b>, <a href=…>, <br> and entities in its texts.
  const as_text = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;');

  const stability = (point) => {
    const unstable = points.unstable[point];
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

  // One trace for all lines of a branch with the same stability; gaps part them.
  const line_traces = ({ across, up }) => {
    const traces = new Map();
    const dashes = { stable: 'solid', unstable: 'dash', undecided: 'dot' };
    for (const line of data.lines) {
      const key = `${line.branch} ${line.stability}`;
      if (!traces.has(key)) {
        traces.set(key, { type: 'scatter', mode: 'lines', x: [], y: [], customdata: [], hovertext: [], hoverinfo: 'text',
          connectgaps: false, line: { color: of_branch(line.colour), width: 2.2, dash: dashes[line.stability] } });
      }
      const trace = traces.get(key);
      for (let i = line.first; i <= line.last; ++i) {
        trace.x.push(across.values[i]);
        trace.y.push(up.values[i]);
        trace.customdata.push(i);
        trace.hovertext.push(hover_text(i));
      }
      trace.x.push(null);
      trace.y.push(null);
      trace.customdata.push(null);
      trace.hovertext.push('');
    }
    return [...traces.values()];
  };

  // Where the structure falls to from a loss of stability, λ held: over monitors alone, of which landings tell.
  const fall_arrows = ({ across, up }) => {
    const monitor = columns.findIndex(({ name }) => name === across.key);
    if (up !== load || monitor < 0) return [];
    return data.jumps.map((jump) => ({ x: jump.to[monitor], y: jump.lambda, ax: jump.from[monitor], ay: jump.lambda,
      xref: 'x', yref: 'y', axref: 'x', ayref: 'y', text: '', showarrow: true, arrowhead: 2, arrowwidth: 2,
      arrowcolor: colour('force') }));
  };

  // Where the events are, if the rest of the curve would leave them a small part of the picture; else null. It goes from
  // the start to the last event of each branch that has one.
  const view_of_events = ({ across, up }) => {
    const last = new Map();
    for (const event of events)
      if (event.kind !== 'start' && event.kind !== 'end') last.set(points.branch[event.point], event.point);
    if (last.size === 0) return null;
    const seen = (i) => i <= (last.get(points.branch[i]) ?? -1);
    const range = (values, is_in) => {
      let low = Infinity, high = -Infinity;
      values.forEach((value, i) => {
        if (value === null || !is_in(i)) return;
        low = Math.min(low, value);
        high = Math.max(high, value);
      });
      return [low, high];
    };
    const ranges = [across.values, up.values].map((values) => [range(values, seen), range(values, () => true)]);
    const small = 0.4;
    const width = ([low, high]) => high - low;
    if (!ranges.some(([near, all]) => width(near) < small * width(all))) return null;
    return ranges.map(([near, all]) => {
      const margin = 0.12 * (width(near) || width(all) || 1);
      return [near[0] - margin, near[1] + margin];
    });
  };

  // Marks of hundreds of changes of contact would cover each other and the curve: of those that stand closer than their
  // size one is drawn. Other events always are.
  const drawn_events = ({ across, up }, view, size) => {
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
    const few = 40;
    const is_contact = ({ kind }) => /^contact-(closes|opens|spreads|gathers|passes)$/.test(kind);
    if (events.filter(is_contact).length <= few) return events;
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

  // Other runs and measured points, where they have both quantities.
  const overlay_traces = ({ across, up }) => data.overlays.filter(({ values }) => values[across.key] && values[up.key]).map((other) => {
    const [x, y] = [across, up].map(({ key }) => values_with_gaps(other, key));
    return { type: 'scatter', mode: other.measured ? 'markers' : 'lines', hoverinfo: 'text', connectgaps: false, x, y,
      hovertext: y.map((value, i) => as_text(`${other.name}: ${up.name} = ${round(value, 8)}, ${across.name} = ${round(x[i], 8)}`)),
      line: { color: other.colour, width: 1.6 },
      marker: { color: other.colour, size: 7, symbol: 'x-thin', line: { color: other.colour, width: 1.6 } } };
  });
  const values_with_gaps = (other, key) => {
    const values = [...other.values[key]];
    for (const first of [...other.firsts].reverse()) if (first > 0) values.splice(first, 0, null);
    return values;
  };

  const plotly_chart = (picked) => {
    const plot = element('plot');
    const here_trace = () => ({ type: 'scatter', mode: 'markers', x: [], y: [], hoverinfo: 'skip',
      marker: { size: 20, symbol: 'circle-open', color: colour('force'), line: { width: 3 } } });
    const axis = (title) => ({ title: { text: as_text(title), standoff: 8 }, zeroline: false, gridcolor: colour('grid'),
      linecolor: colour('edge'), automargin: true });
    let shown = { across: first_across, up: load }, marked = 0, traces = 0, marks = -1;
    const sizes = () => [plot.clientWidth - 80, plot.clientHeight - 80];
    const whole = () => [shown.across, shown.up].map(({ values }) => {
      const finite = values.filter((value) => value !== null);
      return [finite.reduce((a, b) => Math.min(a, b), Infinity), finite.reduce((a, b) => Math.max(a, b), -Infinity)];
    });
    const say_what_is_drawn = (drawn, cut) => {
      const notes = [];
      if (cut) notes.push('The curve goes on beyond this view, which shows the events; a double click shows all of it, another one goes back.');
      if (drawn.length < events.length) notes.push(`${drawn.length} of ${events.length} events are marked; the others appear where the curve is enlarged.`);
      element('plot-note').textContent = notes.join(' ');
    };
    const draw = () => {
      const view = view_of_events(shown);
      const drawn = drawn_events(shown, view ?? whole(), sizes());
      const lines = line_traces(shown), others = overlay_traces(shown);
      const all = [...lines, ...others, event_trace(shown, drawn), here_trace()];
      traces = all.length;
      marks = lines.length + others.length;
      const narrow = window.matchMedia('(max-width: 860px)').matches;
      const [x, y] = view ? view.map((range) => ({ range, autorange: false })) : [{}, {}];
      const layout = { autosize: true, xaxis: { ...axis(shown.across.title), ...x }, yaxis: { ...axis(shown.up.title), ...y },
        margin: { l: 10, r: 12, t: narrow ? 34 : 28, b: 10 }, showlegend: false, hovermode: 'closest', dragmode: narrow ? false : 'zoom',
        hoverlabel: { align: 'left', bgcolor: colour('paper'), bordercolor: colour('edge'), font: { color: colour('ink'), size: 13 } },
        font: { family: 'system-ui, "Segoe UI", Roboto, Arial, sans-serif', size: 13, color: colour('ink') },
        modebar: { bgcolor: 'rgba(0,0,0,0)', color: colour('soft'), activecolor: colour('accent') },
        paper_bgcolor: colour('paper'), plot_bgcolor: colour('paper'),
        annotations: fall_arrows(shown) };
      const config = { responsive: true, displaylogo: false, doubleClick: 'reset+autosize',
        modeBarButtons: [['toImage', 'zoom2d', 'pan2d', 'zoomIn2d', 'zoomOut2d', 'resetScale2d']],
        toImageButtonOptions: { filename: 'load', scale: 2 } };
      Plotly.newPlot(plot, all, layout, config);
      listen();
      say_what_is_drawn(drawn, view !== null);
      mark(marked);
    };
    // Where the reader has enlarged the curve there is room for more marks.
    const mark_events_again = () => {
      const { xaxis, yaxis } = plot._fullLayout;
      const drawn = drawn_events(shown, [xaxis.range, yaxis.range].map((range) => range.map(Number)), sizes());
      if (drawn.length === plot.data[marks].x.length) return;
      const { x, y, customdata, hovertext, marker } = event_trace(shown, drawn);
      Plotly.restyle(plot, { x: [x], y: [y], customdata: [customdata], hovertext: [hovertext], marker: [marker] }, [marks]);
      say_what_is_drawn(drawn, false);
    };
    const mark = (point) => {
      marked = point;
      const here = { x: [shown.across.values[point]], y: [shown.up.values[point]] };
      const at_once = { mode: 'immediate', transition: { duration: 0 }, frame: { duration: 0, redraw: false } };
      Plotly.animate(plot, { data: [here], traces: [traces - 1] }, at_once);
    };
    const listen = () => {
      plot.on('plotly_click', (click) => {
        const point = click.points[0]?.customdata;
        if (Number.isInteger(point)) picked(point);
      });
      plot.on('plotly_relayout', (changed) => {
        if (Object.keys(changed).some((key) => /axis\.(range|autorange)/.test(key))) mark_events_again();
      });
    };
    draw();
    window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);
    return { choose: (across, up) => { shown = { across, up }; draw(); }, mark };
  };

  const picture_chart = (picked) => {
    element('plot').remove();
    element('up').remove();
    const pictured = columns.length > 0 ? quantities.slice(1, 1 + columns.length) : [first_across];
    const figures = [...element('charts').children];
    const scale = (text) => {
      const [low, high, low_place, high_place] = text.split(' ').map(Number);
      return (value) => low_place + (value - low) / (high - low) * (high_place - low_place);
    };
    const pictures = figures.map((figure, monitor) => {
      const chart = figure.firstElementChild, here = svg('circle');
      const to_x = scale(chart.dataset.across), to_y = scale(chart.dataset.up);
      const place = (point) => [to_x(pictured[monitor].values[point]), to_y(points.lambda[point])];
      here.setAttribute('class', 'here');
      here.setAttribute('r', '9');
      chart.append(here);
      chart.addEventListener('click', (click) => {
        const at = new DOMPoint(click.clientX, click.clientY).matrixTransform(chart.getScreenCTM().inverse());
        let nearest = -1, least = 30;
        for (let point = 0; point < points.lambda.length; ++point) {
          const [x, y] = place(point);
          const distance = Math.hypot(x - at.x, y - at.y);
          if (distance < least) [nearest, least] = [point, distance];
        }
        if (nearest >= 0) picked(nearest);
      });
      return { here, place };
    });
    element('charts').classList.add('chosen-only');
    const choose = (across) => figures.forEach((figure, i) => figure.classList.toggle('chosen', pictured[i] === across));
    choose(first_across);
    const mark = (point) => {
      for (const { here, place } of pictures) {
        const [x, y] = place(point);
        const drawn = Number.isFinite(x) && Number.isFinite(y);
        here.setAttribute('visibility', drawn ? 'visible' : 'hidden');
        if (drawn) {
          here.setAttribute('cx', x.toFixed(1));
          here.setAttribute('cy', y.toFixed(1));
        }
      }
    };
    return { choose, mark };
  };

  // --- the point that is shown ---------------------------------------------------------------------------------------

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

  const most_rows = Math.min(shapes.reduce((most, { contacts }) => Math.max(most, contacts.length), 0), 6);
  const show_shape = (shape) => {
    for (const drawn of document.querySelectorAll('#shown [data-path]'))
      drawn.setAttribute('d', shape.paths[Number(drawn.dataset.path)]);
    const pressure_unit = data.force_unit && data.length_unit ? `${data.force_unit}/${data.length_unit}` : '';
    const force = ([, , , size, pressure]) => with_unit(round(size, 5), data.force_unit) +
      (pressure === null ? '' : `, ${with_unit(round(pressure, 5), pressure_unit)}`);
    const most = 5;
    const contacts = [...shape.contacts].sort((a, b) => b[3] - a[3]);
    const rows = contacts.slice(0, most).map((contact) =>
      [contact[0], `${contact[1]}:${round(contact[2], 4)}`, force(contact)]);
    if (contacts.length > most) rows.push([`and ${contacts.length - most} more`, '', '']);
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

  const show_event = (point) => {
    const said = (events_at.get(point) ?? []).map((event) =>
      without_hyphens(event.kind) + (event.what === '' ? '' : ` – ${event.what}`));
    element('happening').textContent = said.join('; ');
    for (const marked of document.querySelectorAll('#events .here, #strip .here')) marked.classList.remove('here');
    for (const one of document.querySelectorAll(`#events [data-point="${point}"], #strip [data-point="${point}"]`))
      one.classList.add('here');
    show_row(document.querySelector('#events .here'));
  };

  let current = 0;  // shape
  let chart = null;
  let show_forces = () => {};

  const show = (index) => {
    current = Math.min(Math.max(index, 0), shapes.length - 1);
    const { point } = shapes[current];
    element('slider').value = current;
    element('slider').setAttribute('aria-valuetext', `λ = ${load_factor(point, 6)}, point ${point}`);
    show_shape(shapes[current]);
    show_forces(shapes[current]);
    show_values(point);
    show_event(point);
    chart.mark(point);
  };

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

  // --- section forces ------------------------------------------------------------------------------------------------

  const part_of = (over, under) => under ? over / under : null;
  const unit_of = (...parts) => parts.every((part) => part !== '') ? parts.join('') : '';
  const moment_unit = unit_of(data.force_unit, '·', data.length_unit);
  const stress_unit = unit_of(data.force_unit, '/', data.length_unit, '²');
  // From what a member carries at a place: axial force N, shear force Q, moment M.
  const section_forces = [
    { name: 'bending moment M', unit: moment_unit, of: (n, q, m) => m },
    { name: 'axial force N', unit: data.force_unit, of: (n) => n },
    { name: 'shear force Q', unit: data.force_unit, of: (n, q) => q },
    { name: 'curvature of bending M/EI', unit: data.length_unit === '' ? '' : `1/${data.length_unit}`, of: (n, q, m, { EI }) => part_of(m, EI) },
    { name: 'stress at the left face N/A − M h/2I', unit: stress_unit, of: (n, q, m, { A, I, half }) => half && I ? n / A - m * half / I : null },
    { name: 'stress at the right face N/A + M h/2I', unit: stress_unit, of: (n, q, m, { A, I, half }) => half && I ? n / A + m * half / I : null },
  ];

  // `M10 20l5-3 7 2`: the places of a path.
  const places_of = (path) => {
    const numbers = (path.match(/-?\d+/g) ?? []).map(Number), places = [];
    for (let i = 0, x = 0, y = 0; i + 1 < numbers.length; i += 2) places.push([x += numbers[i], y += numbers[i + 1]]);
    return places;
  };

  const forces_panel = () => {
    if (!shapes.some(({ forces }) => forces.length > 0)) {
      element('forces-panel').remove();
      return () => {};
    }
    const quantity_choice = element('force'), member_choice = element('force-member'), picture = element('diagram');
    for (const { name, unit } of section_forces) quantity_choice.append(new Option(unit === '' ? name : `${name} [${unit}]`));
    for (const { name } of data.members) member_choice.append(new Option(name));
    const value_at = (force, m) => ([, , n, q, moment]) => force.of(n, q, moment, data.members[m]);
    const width = 640, height = 240, left = 78, right = 12, top = 14, bottom = 34;
    const greatest = (force, members) => shapes.reduce((most, { forces }) => members.reduce((of_members, m) =>
      (forces[m] ?? []).reduce((size, sample) => Math.max(size, Math.abs(value_at(force, m)(sample) ?? 0)), of_members), most), 0);
    let force = section_forces[0], member = 0, scale = 1, scale_on_shape = 1, current_shape = null;

    const draw_curve = (samples) => {
      const values = samples.map(value_at(force, member));
      const x = (fraction) => left + fraction * (width - left - right);
      const y = (value) => top + (1 - value / scale) / 2 * (height - top - bottom);
      const drawn = samples.map(([, fraction], i) => `${i === 0 ? 'M' : 'L'}${x(fraction).toFixed(1)} ${y(values[i] ?? 0).toFixed(1)}`).join('');
      const zero = y(0).toFixed(1), known = values.every((value) => value !== null) && samples.length > 0;
      const text = (at_x, at_y, words, anchor) => {
        const label = svg('text');
        label.setAttribute('x', at_x);
        label.setAttribute('y', at_y);
        label.setAttribute('text-anchor', anchor);
        label.textContent = words;
        return label;
      };
      const path = (name, way) => {
        const line = svg('path');
        line.setAttribute('class', name);
        line.setAttribute('d', way);
        return line;
      };
      picture.replaceChildren(
        path('grid', [0, 0.25, 0.5, 0.75, 1].map((part) => `M${x(part)} ${top}V${height - bottom}`).join('') + `M${left} ${y(scale)}H${width - right}M${left} ${y(-scale)}H${width - right}`),
        path('zero', `M${left} ${zero}H${width - right}`),
        ...(known ? [path('area', `M${x(samples[0][1])} ${zero}L${drawn.slice(1)}L${x(samples.at(-1)[1])} ${zero}z`), path('line', drawn)] : []),
        ...[0, 0.25, 0.5, 0.75, 1].map((part) => text(x(part), height - bottom + 18, String(part), 'middle')),
        ...[scale, 0, -scale].map((value) => text(left - 6, y(value) + 4, round(value, 4), 'end')));
      const extreme = (pick) => {
        const i = values.indexOf(pick(...values));
        return `${with_unit(round(values[i], 6), force.unit)} at ${round(samples[i][1], 4)}`;
      };
      element('diagram-note').textContent = known
        ? `Along the member, from 0 to 1: greatest ${extreme(Math.max)}, least ${extreme(Math.min)}.`
        : 'The section of this member does not say so much.';
    };

    const draw_on_shape = (shape) => {
      const chosen = element('on-shape').checked;
      const longest = 9000;
      element('drawn-forces').replaceChildren(...(chosen ? shape.forces : []).flatMap((samples, m) => {
        const places = places_of(shape.paths[m]), value = value_at(force, m);
        if (samples.some((sample) => value(sample) === null)) return [];
        const tops = samples.map((sample) => {
          const [index] = sample, before = places[Math.max(index - 1, 0)], behind = places[Math.min(index + 1, places.length - 1)];
          const [dx, dy] = [behind[0] - before[0], behind[1] - before[1]], length = Math.hypot(dx, dy) || 1;
          const size = value(sample) / scale_on_shape * longest;
          return [places[index][0] + dy / length * size, places[index][1] - dx / length * size];
        });
        const base = samples.map(([index]) => places[index]).reverse();
        const area = svg('path');
        area.setAttribute('class', 'diagram');
        area.setAttribute('d', `M${[...tops, ...base].map((place) => place.map(Math.round).join(' ')).join('L')}z`);
        return [area];
      }));
    };

    const draw = (shape) => {
      current_shape = shape;
      draw_curve(shape.forces[member] ?? []);
      draw_on_shape(shape);
    };
    const choose = () => {
      force = section_forces[quantity_choice.selectedIndex];
      member = member_choice.selectedIndex;
      scale = greatest(force, [member]) || 1;
      scale_on_shape = greatest(force, data.members.map((_, m) => m)) || 1;
      if (current_shape) draw(current_shape);
    };
    for (const id of ['force', 'force-member', 'on-shape']) element(id).addEventListener('change', choose);
    choose();
    return draw;
  };

  // --- the picture of the shape: nearer, aside, names, and files of it -------------------------------------------------

  const save = (blob, name) => {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  };

  const looks = ['fill', 'stroke', 'stroke-width', 'stroke-dasharray', 'stroke-linecap', 'stroke-linejoin', 'vector-effect', 'opacity'];
  // A picture that needs no style sheet: what the page's says of each part is written into it.
  const picture_alone = (picture) => {
    const copy = picture.cloneNode(true);
    const parts = [...picture.querySelectorAll('*')], copies = [...copy.querySelectorAll('*')];
    parts.forEach((part, i) => {
      const style = getComputedStyle(part);
      for (const look of looks) copies[i].setAttribute(look, style.getPropertyValue(look));
      copies[i].removeAttribute('class');
    });
    const [x, y, width, height] = copy.getAttribute('viewBox').split(' ').map(Number);
    const ground = svg('rect');
    for (const [name, value] of Object.entries({ x, y, width, height, fill: colour('paper') })) ground.setAttribute(name, value);
    copy.prepend(ground);
    copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
    copy.removeAttribute('id');
    copy.removeAttribute('class');
    copy.removeAttribute('style');
    const pixels = 1600 / Math.max(width, height);
    copy.setAttribute('width', Math.round(width * pixels));
    copy.setAttribute('height', Math.round(height * pixels));
    return copy;
  };
  const as_blob = (picture) => new Blob([new XMLSerializer().serializeToString(picture)], { type: 'image/svg+xml' });

  const save_png = (picture, name) => {
    const image = new Image(), address = URL.createObjectURL(as_blob(picture));
    image.onload = () => {
      const canvas = document.createElement('canvas');
      canvas.width = picture.getAttribute('width');
      canvas.height = picture.getAttribute('height');
      canvas.getContext('2d').drawImage(image, 0, 0);
      URL.revokeObjectURL(address);
      canvas.toBlob((blob) => save(blob, name));
    };
    image.src = address;
  };

  const csv = () => {
    const cell = (text) => /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
    const shown = [...quantities.filter(({ key }) => key !== 'lambda' && key !== 'step')];
    const rows = points.lambda.map((value, i) => [points.branch[i], points.step[i], value, ...shown.map(({ values }) => values[i]),
      points.stability[i], (events_at.get(i) ?? []).map(({ kind }) => kind).join(' ')]);
    const titles = ['branch', 'step', 'lambda', ...shown.map(({ title }) => title), 'stability', 'events'];
    return [titles, ...rows].map((row) => row.map((value) => cell(value === null ? '' : String(value))).join(',')).join('\n') + '\n';
  };

  const shape_tools = () => {
    const stage = element('stage'), whole = stage.getAttribute('viewBox').split(' ').map(Number);
    let box = whole;
    const look_at = (next) => {
      const widest = whole[2], width = Math.min(Math.max(next[2], widest / 200), widest), height = width * whole[3] / whole[2];
      const inside = (at, size, from, all) => Math.min(Math.max(at, from), from + all - size);
      box = [inside(next[0], width, whole[0], whole[2]), inside(next[1], height, whole[1], whole[3]), width, height];
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
    element('shape-svg').addEventListener('click', () => save(as_blob(picture_alone(stage)), 'shape.svg'));
    element('shape-png').addEventListener('click', () => save_png(picture_alone(stage), 'shape.png'));
    element('table-csv').addEventListener('click', () => save(new Blob([csv()], { type: 'text/csv' }), 'points.csv'));
    if (typeof Plotly === 'undefined') element('curve-svg').remove();
    else element('curve-svg').addEventListener('click', () => Plotly.downloadImage(element('plot'), { format: 'svg', filename: 'curve', width: 900, height: 600 }));

    const name = (part, text) => {
      const title = svg('title');
      title.textContent = text;
      part.append(title);
    };
    for (const part of document.querySelectorAll('#shown [data-path]')) {
      const member = data.members[Number(part.dataset.path)];
      if (member) name(part, `member ${member.name}`);
    }
    document.querySelectorAll('#walls .body').forEach((part, i) => { if (data.walls[i]) name(part, `wall ${data.walls[i]}`); });
  };

  // --- play ------------------------------------------------------------------------------------------------------------

  let playing = null;  // the number of the animation frame that was asked for
  let walked = false;  // the reader has gone to a point; else a play begins at the first

  const say_playing = (is_playing) => {
    element('play').classList.toggle('playing', is_playing);
    element('play').lastElementChild.textContent = is_playing ? 'Pause' : 'Play';
  };

  const stop = () => {
    walked = true;
    if (playing === null) return;
    cancelAnimationFrame(playing);
    playing = null;
    say_playing(false);
  };

  const play = () => {
    const last = shapes.length - 1;
    const first = !walked || current === last ? 0 : current;
    walked = true;
    const seconds = Math.min(Math.max(shapes.length * 0.06, 4), 24) * (last - first) / Math.max(last, 1);
    let begin = null;
    const advance = (now) => {
      begin ??= now;
      const part = seconds > 0 ? Math.min((now - begin) / (1000 * seconds), 1) : 1;
      const index = first + Math.round(part * (last - first));
      if (index !== current || part === 0) show(index);
      if (part < 1) playing = requestAnimationFrame(advance);
      else stop();
    };
    say_playing(true);
    playing = requestAnimationFrame(advance);
  };

  // --- what the reader does --------------------------------------------------------------------------------------------

  const on_keys = (target, keys) => target.addEventListener('keydown', (pressed) => {
    if (pressed.ctrlKey || pressed.altKey || pressed.metaKey || !(pressed.key in keys)) return;
    pressed.preventDefault();
    keys[pressed.key](pressed);
  });
  const step = (by) => () => { stop(); show(current + by); };
  const toggle = () => playing === null ? play() : stop();
  const walk = { ArrowLeft: step(-1), ArrowRight: step(1), Home: () => { stop(); show(0); },
    End: () => { stop(); show(shapes.length - 1); }, PageUp: () => go_to_event(-1), PageDown: () => go_to_event(1), ' ': toggle };

  // Rows, pictures and words that stand for a point: a click, Enter or Space goes there; of a list one item is in the
  // order of the Tab key, arrows lead to the others.
  const make_list = (items) => items.forEach((item, i) => {
    const point = Number(item.dataset.point);
    const focus = (other) => () => {
      if (!items[other]) return;
      item.tabIndex = -1;
      items[other].tabIndex = 0;
      items[other].focus();
      go_to(Number(items[other].dataset.point));
    };
    item.tabIndex = i === 0 ? 0 : -1;
    item.addEventListener('click', () => go_to(point));
    on_keys(item, { Enter: () => go_to(point), ' ': () => go_to(point), ArrowDown: focus(i + 1), ArrowRight: focus(i + 1),
      ArrowUp: focus(i - 1), ArrowLeft: focus(i - 1), Home: focus(0), End: focus(items.length - 1) });
  });

  if (shapes.length === 0) return;
  document.documentElement.classList.add('js');
  if (typeof Plotly === 'undefined') {
    chart = picture_chart(go_to);
  } else {
    element('charts').classList.add('drawn-by-library');
    chart = plotly_chart(go_to);
    on_keys(element('plot'), walk);
  }
  show_forces = forces_panel();
  shape_tools();
  const choices = [...quantities.slice(1, 1 + columns.length), ...(columns.length > 0 ? [quantities.find(({ key }) => key === 'arc')] : [first_across])];
  if (element('up')) {
    for (const { title } of quantities) element('up').append(new Option(title));
    const there = new Set(choices);
    for (const more of quantities.filter((one) => !there.has(one))) choices.push(more);
    for (const { title } of choices.slice(element('monitor').options.length)) element('monitor').append(new Option(title));
  }
  const choose = () => chart.choose(choices[element('monitor').selectedIndex], quantities[element('up')?.selectedIndex ?? 0]);
  for (const id of ['monitor', 'up']) element(id)?.addEventListener('change', choose);
  element('slider').addEventListener('input', (moved) => { stop(); show(Number(moved.target.value)); });
  on_keys(element('slider'), { PageUp: walk.PageUp, PageDown: walk.PageDown, ' ': toggle });
  element('play').addEventListener('click', toggle);
  element('event-before').addEventListener('click', () => go_to_event(-1));
  element('event-after').addEventListener('click', () => go_to_event(1));
  make_list([...document.querySelectorAll('#events tbody tr')]);
  make_list([...document.querySelectorAll('#strip figure')]);
  make_list([...document.querySelectorAll('.tree [data-point]')]);
  const asked_for = /^#point=(\d+)$/.exec(window.location.hash);  // report.html#point=30
  const turning = ['limit-point', 'contact-limit-point', 'branch-point'];
  const opening = asked_for ? Number(asked_for[1]) : events.find((event) => turning.includes(event.kind))?.point ?? 0;
  walked = asked_for !== null;
  show(shape_near(opening));
})();
