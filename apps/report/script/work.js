// The area under the curve between two of its points: the work of a force along a way.
// By trapezia. Of two steps they leave out about a third of what one trapezium over both would change; these parts are
// added whatever their signs.
const area_under = (from, to, { across, up }) => {
  const direction = to < from ? -1 : 1;
  for (let i = Math.min(from, to); i <= Math.max(from, to); ++i) if (across.values[i] === null || up.values[i] === null) return null;
  const trapezium = (i, j) => 0.5 * (up.values[i] + up.values[j]) * (across.values[j] - across.values[i]);
  let area = 0, doubt = 0;
  for (let i = from; i !== to;) {
    const middle = i + direction, next = middle === to ? to : middle + direction;
    const fine = trapezium(i, middle) + trapezium(middle, next);
    area += fine;
    doubt += Math.abs(fine - trapezium(i, next)) / 3;
    i = next;
  }
  return { area, doubt };
};

// `λ, times 2 kN`: the unit of what stands in brackets or behind `times`.
const unit_in = (title) => /\[([^\]]*)\]/.exec(title)?.[1] ?? '';

const work_text = (from, to, shown) => {
  const { across, up } = shown;
  if (from === null || to === null) return from === null && to === null ? '' : 'Go to another point, and choose it as the other end.';
  if (points.branch[from] !== points.branch[to])
    return `These two points lie on the branches ${points.branch[from]} and ${points.branch[to]}; the work is that along one branch.`;
  const found = area_under(from, to, shown);
  if (found === null) return `There is no work: ${up.name} or ${across.name} has no value at a point between.`;
  const unit = [unit_in(up.title), unit_in(across.title)].filter((one) => one !== '').join('·');
  const energy = points.energy[from] === null || points.energy[to] === null ? ''
    : ` The total potential energy, which has the loads in it, changes by ${with_unit(round(points.energy[to] - points.energy[from], 6), data.energy_unit)}.`;
  return `From λ = ${load_factor(from, 6)} to λ = ${load_factor(to, 6)} along branch ${points.branch[from]}: ` +
    `∫ ${up.name} d(${across.name}) = ${with_unit(`${round(found.area, 6)} ± ${round(found.doubt, 1)}`, unit)}.` +
    (up === load ? ` Multiplied by the load at λ = 1 this is the work of that load, if ${across.name} is the way of its point along it.` : '') + energy;
};

const work_panel = (axes) => {
  let from = null, to = null, shown = axes;
  const show_work = () => {
    const is_there = from !== null && to !== null && points.branch[from] === points.branch[to];
    element('work').textContent = work_text(from, to, shown);
    chart.shade(is_there ? [from, to] : null);
  };
  element('work-from').addEventListener('click', () => { from = shapes[current].point; show_work(); });
  element('work-to').addEventListener('click', () => { to = shapes[current].point; show_work(); });
  return (across, up) => { shown = { across, up }; show_work(); };
};
