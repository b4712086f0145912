// Curves through points with known tangents: between two points the cubic of Hermite, whose parameter is the arc length.
// A curve has `arc`, and of each quantity that it has by its key `values`, and `before` and `after`: derivatives by the
// arc length on both sides of a point, which differ at a kink. Without them steps are straight.
const curve_of_the_path = () => {
  const count = points.lambda.length, empty = () => new Array(count).fill(null);
  const own = Object.fromEntries(quantities.map(({ key, values }) => [key, values]));
  const known = [...quantities.slice(0, 1 + columns.length).map(({ key }) => key), 'energy'];
  const before = Object.fromEntries(known.map((key) => [key, empty()])), after = Object.fromEntries(known.map((key) => [key, empty()]));
  for (const [point, arriving, leaving = arriving] of data.rates)
    known.forEach((key, k) => {
      before[key][point] = arriving[k];
      after[key][point] = leaving[k];
    });
  for (const key of ['arc', 'arc of the run']) if (!before[key]) before[key] = after[key] = points.arc.map(() => 1);
  return { arc: points.arc, values: own, before, after };
};

// How far a cubic is from its chord, in parts of the picture, is at most 4/27 of what its end tangents are off the chord.
const most_parts = 40, finest = 1e-4;
const parts_of_step = (ends, sizes) => {
  const off = ends.reduce((sum, { from, to, leaves, arrives }, k) => {
    const chord = to - from;
    return sum + Math.hypot(leaves - chord, arrives - chord) / sizes[k];
  }, 0);
  return Math.min(Math.max(Math.ceil(Math.sqrt(4 / 27 * off / finest)), 1), most_parts);
};

const at_part = ({ from, to, leaves, arrives }, t) => {
  const u = 1 - t;
  return u * u * (1 + 2 * t) * from + t * t * (1 + 2 * u) * to + t * u * (u * leaves - t * arrives);
};

// The step from point i − 1 to point i in one quantity: values at its ends, and derivatives times its length.
const step_of = (curve, key, i) => {
  const length = curve.arc[i] - curve.arc[i - 1];
  const [from, to] = [curve.values[key][i - 1], curve.values[key][i]];
  const rates = [curve.after[key]?.[i - 1], curve.before[key]?.[i]];
  const is_known = rates.every((rate) => rate !== null && rate !== undefined);
  const [leaves, arrives] = is_known ? rates.map((rate) => rate * length) : [to - from, to - from];
  const is_monotone = key === 'lambda' || data.turning_known.includes(key);
  return { from, to, ...is_monotone ? monotone(to - from, leaves, arrives) : { leaves, arrives } };
};

// λ, and monitors whose turning points are known, are monotone between points: Fritsch and Carlson (1980). A derivative of
// the other sense is that behind a kink; the parabola of the other one takes its place.
const monotone = (chord, leaves, arrives) => {
  const kept = (value, other) => value * chord < 0 ? 2 * chord - other : value;
  const limited = (value) => Math.min(Math.max(value, Math.min(0, 3 * chord)), Math.max(0, 3 * chord));
  return { leaves: limited(kept(leaves, arrives)), arrives: limited(kept(arrives, leaves)) };
};

// What is smooth between the points `first` and `last`, as x and y of a polygon that cannot be told from it.
// `sizes`: of the picture in both quantities.
const drawn_curve = (curve, across, up, sizes, first, last) => {
  const x = [curve.values[across][first]], y = [curve.values[up][first]];
  for (let i = first + 1; i <= last; ++i) {
    const steps = [step_of(curve, across, i), step_of(curve, up, i)];
    const are_there = steps.every(({ from, to }) => from !== null && to !== null);
    const parts = are_there ? parts_of_step(steps, sizes) : 1;
    for (let part = 1; part < parts; ++part) {
      x.push(at_part(steps[0], part / parts));
      y.push(at_part(steps[1], part / parts));
    }
    x.push(steps[0].to);
    y.push(steps[1].to);
  }
  return { x, y };
};

const range_of = (values) => values.reduce(([low, high], value) =>
  value === null ? [low, high] : [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);
const sizes_of = (...all) => all.map((values) => {
  const [low, high] = range_of(values);
  return high > low ? high - low : 1;
});
const path_curve = curve_of_the_path();
