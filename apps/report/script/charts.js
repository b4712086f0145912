// The chart: plotly's where the page carries it, else the pictures of the page.
// `opening`: the point that is marked at first. `kept`: the plot of the run before, which is changed instead of drawn anew;
// `keeps_axes`: with its axes, if the curve is within them.
const plotly_chart = (picked, axes, opening, kept, keeps_axes) => {
  if (kept) element('plot').replaceWith(kept);
  const plot = element('plot');
  // `marked`: a number, or a jump whose end is marked.
  const here_trace = () => {
    const [x, y] = [shown.across, shown.up].map((quantity) => typeof marked === 'number' ? quantity.values[marked]
      : in_state(quantity, marked.lambda, marked.to, marked.energy));
    return { type: 'scatter', mode: 'markers', x: [x ?? null], y: [y ?? null], hoverinfo: 'skip',
      marker: { size: 20, symbol: 'circle-open', color: colour('force'), line: { width: 3 } } };
  };
  // The area under a part of the curve; the first of the traces, so that the others stand on it.
  const area_trace = () => {
    const [first, last] = shaded ? [Math.min(...shaded), Math.max(...shaded)] : [0, 0];
    const sizes = sizes_of(shown.across.values, shown.up.values);
    const { x, y } = shaded ? drawn_curve(path_curve, shown.across.key, shown.up.key, sizes, first, last) : { x: [null], y: [null] };
    return { type: 'scatter', mode: 'lines', hoverinfo: 'skip', fill: 'tozeroy', fillcolor: `${colour('accent')}33`, line: { width: 0 }, x, y };
  };
  let shown = axes, marked = opening, marks = -1, shaded = null, released = false;
  const sizes = () => [plot.clientWidth - 80, plot.clientHeight - 80];
  const whole = () => [shown.across, shown.up].map(({ values }) => range_of(values));
  const say_what_is_drawn = (drawn, cut) => {
    const notes = [];
    if (cut) notes.push('The curve goes on beyond this view, which shows the events; a double click shows all of it, another one goes back.');
    if (drawn.length < events.length) notes.push(`${drawn.length} of ${events.length} events are marked; the others appear where the curve is enlarged.`);
    element('plot-note').textContent = notes.join(' ');
  };
  // Lines without a place, for those that are drawn and that this run has not.
  const empty_lines = (all, line) =>
    Array.from({ length: Math.max(plot.data.length - all.length, 0) }, () => ({ ...line, x: [null], y: [null] }));
  // Whether these traces can take the place of those that are drawn, with the same properties, and lie within their axes.
  const ranges_of = (all) => ['x', 'y'].map((way) => range_of(all.flatMap((trace) => trace[way])));
  const has_room_for = (all, ranges) => {
    const is_table = (value) => typeof value === 'object' && !Array.isArray(value);
    const properties = (trace) => JSON.stringify(trace, (key, value) => key === 'mode' || is_table(value) ? value : null);
    const properties_of = (traces) => traces.map(properties).join(' ');
    const is_on = (axis, { title }, [low, high]) => axis.title.text === as_text(title) && axis.range[0] <= low && high <= axis.range[1];
    const { xaxis, yaxis } = plot.layout;
    return properties_of(all) === properties_of(plot.data) && is_on(xaxis, shown.across, ranges[0]) && is_on(yaxis, shown.up, ranges[1]);
  };
  const at_once = { mode: 'immediate', transition: { duration: 0 }, frame: { duration: 0, redraw: false } };
  // With its axes kept plotly changes the traces alone, in a fifth of the time.
  const draw = (keep_axes = false) => {
    const view = view_of_events(shown);
    const drawn = drawn_events(shown, view ?? whole(), sizes);
    const lines = line_traces(shown), others = overlay_traces(shown);
    const all = [area_trace(), ...lines, jump_arrows(shown), ...others, event_trace(shown, drawn), here_trace()];
    if (keep_axes) all.splice(1, 0, ...empty_lines(all, lines[0]));
    marks = all.length - 2;
    opened = view;
    say_what_is_drawn(drawn, view !== null);
    if (keep_axes && has_room_for(all, view ?? ranges_of(all))) return Plotly.animate(plot, { data: all, traces: all.map((_, i) => i) }, at_once);
    const [x, y] = view ? view.map((range) => ({ range, autorange: false })) : [{}, {}];
    return Plotly.react(plot, all, plot_layout({ ...plot_axis(shown.across.title), ...x }, { ...plot_axis(shown.up.title), ...y }), config);
  };
  // From the view with which the curve opened to all of it, and from any other back to that.
  let opened = null;
  const is_as_opened = () => opened !== null && [plot._fullLayout.xaxis, plot._fullLayout.yaxis].every(({ range }, i) =>
    range.every((value, k) => Math.abs(value - opened[i][k]) <= 1e-6 * Math.abs(opened[i][1] - opened[i][0])));
  const reset = () => Plotly.relayout(plot, opened !== null && !is_as_opened()
    ? { 'xaxis.range': [...opened[0]], 'yaxis.range': [...opened[1]] } : { 'xaxis.autorange': true, 'yaxis.autorange': true });
  const config = { ...plot_config, doubleClick: false,
    modeBarButtons: [[...plot_buttons, { name: 'reset', title: 'Reset axes', icon: Plotly.Icons.home, click: reset }]],
    toImageButtonOptions: { filename: 'load', scale: 2 } };
  // Where the reader has enlarged the curve there is room for more marks.
  const mark_events_again = () => {
    const { xaxis, yaxis } = plot._fullLayout;
    const drawn = drawn_events(shown, [xaxis.range, yaxis.range].map((range) => range.map(Number)), sizes);
    if (drawn.length === plot.data[marks].x.length) return;
    const { x, y, customdata, hovertext, marker } = event_trace(shown, drawn);
    Plotly.restyle(plot, { x: [x], y: [y], customdata: [customdata], hovertext: [hovertext], marker: [marker] }, [marks]);
    say_what_is_drawn(drawn, false);
  };
  const mark = (point) => {
    if (point === marked) return;
    marked = point;
    const { x, y } = here_trace();
    Plotly.animate(plot, { data: [{ x, y }], traces: [marks + 1] }, at_once);
  };
  // A plot that is kept has its listeners: they call what the run that is shown has set here.
  const listen = () => {
    const is_new = plot.answers === undefined;
    plot.answers = {
      click: (click) => {
        const point = click.points[0]?.customdata;
        if (Number.isInteger(point)) picked(point);
      },
      relayout: (changed) => {
        if (Object.keys(changed).some((key) => /axis\.(range|autorange)/.test(key))) mark_events_again();
      },
      doubleclick: reset,
    };
    if (is_new) for (const name of Object.keys(plot.answers)) plot.on(`plotly_${name}`, (happened) => plot.answers[name](happened));
  };
  draw(keeps_axes);
  listen();
  window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => draw(), { signal: closing.signal });
  closing.signal.addEventListener('abort', () => { if (!released) Plotly.purge(plot); });
  const release = () => {
    released = true;
    return plot;
  };
  const shade = (ends) => {
    shaded = ends;
    const { x, y } = area_trace();
    Plotly.restyle(plot, { x: [x], y: [y] }, [0]);
  };
  return { choose: (across, up) => { shown = { across, up }; draw(); }, draw, mark, shade, release };
};

const picture_chart = (picked, axes) => {
  element('plot').remove();
  element('up').remove();
  const pictured = columns.length > 0 ? quantities.slice(1, 1 + columns.length) : [first_across];
  const figures = [...element('charts').children], exchanged = data.moved && columns.length > 0;
  const scale = (text) => {
    const [low, high, low_place, high_place] = text.split(' ').map(Number);
    return (value) => low_place + (value - low) / (high - low) * (high_place - low_place);
  };
  const pictures = figures.map((figure, monitor) => {
    const chart = figure.firstElementChild, here = svg('circle');
    const to_x = scale(chart.dataset.across), to_y = scale(chart.dataset.up);
    const value = (point) => typeof point === 'number' ? pictured[monitor].values[point] : in_state(pictured[monitor], point.lambda, point.to);
    const place = (point) => {
      const lambda = typeof point === 'number' ? points.lambda[point] : point.lambda;
      return exchanged ? [to_x(lambda), to_y(value(point))] : [to_x(value(point)), to_y(lambda)];
    };
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
  choose(pictured.includes(axes.across) ? axes.across : first_across);
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
  return { choose, draw: () => {}, mark, shade: () => {}, release: () => undefined };
};
