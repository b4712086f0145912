// The chart: plotly's where the page carries it, else the pictures of the page.
// `kept`: the plot of the run before, which is changed instead of drawn anew.
const plotly_chart = (picked, axes, kept) => {
  if (kept) element('plot').replaceWith(kept);
  const plot = element('plot');
  const here_trace = () => ({ type: 'scatter', mode: 'markers', x: [], y: [], hoverinfo: 'skip',
    marker: { size: 20, symbol: 'circle-open', color: colour('force'), line: { width: 3 } } });
  // The area under a part of the curve; the first of the traces, so that the others stand on it.
  const area_trace = () => {
    const [first, last] = shaded ? [Math.min(...shaded), Math.max(...shaded)] : [0, 0];
    const sizes = sizes_of(shown.across.values, shown.up.values);
    const { x, y } = shaded ? drawn_curve(path_curve, shown.across.key, shown.up.key, sizes, first, last) : { x: [], y: [] };
    return { type: 'scatter', mode: 'lines', hoverinfo: 'skip', fill: 'tozeroy', fillcolor: `${colour('accent')}33`, line: { width: 0 }, x, y };
  };
  let shown = axes, marked = 0, traces = 0, marks = -1, shaded = null, released = false;
  const sizes = () => [plot.clientWidth - 80, plot.clientHeight - 80];
  const whole = () => [shown.across, shown.up].map(({ values }) => range_of(values));
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
    const all = [area_trace(), ...lines, ...others, event_trace(shown, drawn), here_trace()];
    traces = all.length;
    marks = 1 + lines.length + others.length;
    const [x, y] = view ? view.map((range) => ({ range, autorange: false })) : [{}, {}];
    const layout = { ...plot_layout({ ...plot_axis(shown.across.title), ...x }, { ...plot_axis(shown.up.title), ...y }), annotations: jump_arrows(shown) };
    Plotly.react(plot, all, layout, config);
    opened = view;
    say_what_is_drawn(drawn, view !== null);
    mark(marked);
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
    const drawn = drawn_events(shown, [xaxis.range, yaxis.range].map((range) => range.map(Number)), sizes());
    if (drawn.length === plot.data[marks].x.length) return;
    const { x, y, customdata, hovertext, marker } = event_trace(shown, drawn);
    Plotly.restyle(plot, { x: [x], y: [y], customdata: [customdata], hovertext: [hovertext], marker: [marker] }, [marks]);
    say_what_is_drawn(drawn, false);
  };
  // `point`: a number, or a jump whose end is marked.
  const mark = (point) => {
    marked = point;
    const [x, y] = [shown.across, shown.up].map((quantity) => typeof point === 'number' ? quantity.values[point]
      : in_state(quantity, point.lambda, point.to));
    const here = { x: [x ?? null], y: [y ?? null] };
    const at_once = { mode: 'immediate', transition: { duration: 0 }, frame: { duration: 0, redraw: false } };
    Plotly.animate(plot, { data: [here], traces: [traces - 1] }, at_once);
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
  draw();
  listen();
  window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw, { signal: closing.signal });
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
  return { choose: (across, up) => { shown = { across, up }; draw(); }, mark, shade, release };
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
  return { choose, mark, shade: () => {}, release: () => undefined };
};
