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

  // Values of a chart's horizontal axis: a monitor, or the points' numbers where there is none.
  const across = (monitor) => columns.length > 0 ? points.monitors[monitor] : points.arc;

  // --- the chart: plotly's where the page carries it, else the pictures of the page ----------------------------------

  const ink = '#1c1f23';

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
  const line_traces = (monitor) => {
    const traces = new Map();
    const dashes = { stable: 'solid', unstable: 'dash', undecided: 'dot' };
    for (const line of data.lines) {
      const key = `${line.branch} ${line.stability}`;
      if (!traces.has(key)) {
        traces.set(key, { type: 'scatter', mode: 'lines', x: [], y: [], customdata: [], hovertext: [], hoverinfo: 'text',
          connectgaps: false, line: { color: line.colour, width: 2.2, dash: dashes[line.stability] } });
      }
      const trace = traces.get(key);
      for (let i = line.first; i <= line.last; ++i) {
        trace.x.push(across(monitor)[i]);
        trace.y.push(points.lambda[i]);
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

  const marked = [...events].sort((a, b) => b.size - a.size);  // a small mark stands on a large one
  const event_trace = (monitor) => ({
    type: 'scatter', mode: 'markers', hoverinfo: 'text',
    x: marked.map((event) => across(monitor)[event.point]),
    y: marked.map((event) => points.lambda[event.point]),
    customdata: marked.map((event) => event.point),
    hovertext: marked.map((event) => hover_text(event.point)),
    marker: { opacity: 1, size: marked.map((event) => event.size), symbol: marked.map((event) => event.symbol),
      color: marked.map((event) => event.filled ? ink : '#fff'), line: { color: ink, width: 1.4 } },
  });

  const here_trace = { type: 'scatter', mode: 'markers', x: [], y: [], hoverinfo: 'skip',
    marker: { size: 20, symbol: 'circle-open', color: '#d55e00', line: { width: 3 } } };

  const plotly_chart = (picked) => {
    const plot = element('plot');
    const axis = (title) => ({ title: { text: as_text(title), standoff: 8 }, zeroline: false, gridcolor: '#e8eaed',
      linecolor: '#aeb5bd', automargin: true });
    let monitor = 0, marked = 0, traces = 0;
    const draw = () => {
      const all = [...line_traces(monitor), event_trace(monitor), here_trace];
      traces = all.length;
      const narrow = window.matchMedia('(max-width: 860px)').matches;
      const layout = { autosize: true, xaxis: axis(columns.length > 0 ? columns[monitor].title : 'arc length'), yaxis: axis(data.load_title),
        margin: { l: 10, r: 12, t: narrow ? 34 : 28, b: 10 }, showlegend: false, hovermode: 'closest', dragmode: narrow ? false : 'zoom',
        hoverlabel: { align: 'left', bgcolor: '#fff', bordercolor: '#aeb5bd', font: { color: ink, size: 13 } },
        font: { family: 'system-ui, "Segoe UI", Roboto, Arial, sans-serif', size: 13, color: ink },
        paper_bgcolor: '#fff', plot_bgcolor: '#fff',
        annotations: columns.length === 0 ? [] : data.jumps.map((jump) => ({ x: jump.to[monitor], y: jump.lambda,
          ax: jump.from[monitor], ay: jump.lambda, xref: 'x', yref: 'y', axref: 'x', ayref: 'y', text: '',
          showarrow: true, arrowhead: 2, arrowwidth: 2, arrowcolor: '#d55e00' })) };
      const config = { responsive: true, displaylogo: false, doubleClick: 'reset',
        modeBarButtons: [['toImage', 'zoom2d', 'pan2d', 'zoomIn2d', 'zoomOut2d', 'resetScale2d']],
        toImageButtonOptions: { filename: 'load', scale: 2 } };
      Plotly.react(plot, all, layout, config);
      mark(marked);
    };
    const mark = (point) => {
      marked = point;
      const here = { x: [across(monitor)[point]], y: [points.lambda[point]] };
      const at_once = { mode: 'immediate', transition: { duration: 0 }, frame: { duration: 0, redraw: false } };
      Plotly.animate(plot, { data: [here], traces: [traces - 1] }, at_once);
    };
    draw();
    plot.on('plotly_click', (click) => {
      const point = click.points[0]?.customdata;
      if (Number.isInteger(point)) picked(point);
    });
    return { choose: (chosen) => { monitor = chosen; draw(); }, mark };
  };

  const picture_chart = (picked) => {
    element('plot').remove();
    const figures = [...element('charts').children];
    const scale = (text) => {
      const [low, high, low_place, high_place] = text.split(' ').map(Number);
      return (value) => low_place + (value - low) / (high - low) * (high_place - low_place);
    };
    const pictures = figures.map((figure, monitor) => {
      const chart = figure.firstElementChild, here = svg('circle');
      const to_x = scale(chart.dataset.across), to_y = scale(chart.dataset.up);
      const place = (point) => [to_x(across(monitor)[point]), to_y(points.lambda[point])];
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
    const choose = (chosen) => figures.forEach((figure, i) => figure.classList.toggle('chosen', i === chosen));
    choose(0);
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

  const show = (index) => {
    current = Math.min(Math.max(index, 0), shapes.length - 1);
    const { point } = shapes[current];
    element('slider').value = current;
    element('slider').setAttribute('aria-valuetext', `λ = ${load_factor(point, 6)}, point ${point}`);
    show_shape(shapes[current]);
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
  element('monitor').addEventListener('change', (changed) => chart.choose(changed.target.selectedIndex));
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
