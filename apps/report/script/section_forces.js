// Diagrams of section forces along a member, and on the shape.
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
  ...data.members.some(({ allowable }) => allowable)
    ? [{ name: 'use of the allowable stress', unit: '', of: (n, q, m, { A, I, half, allowable }) =>
      allowable && (half || !I) ? (Math.abs(n) / A + (I ? Math.abs(m) * half / I : 0)) / allowable : null }]
    : [],
];

const forces_panel = () => {
  if (!shapes.some(({ forces }) => forces.length > 0)) {
    element('forces-panel').remove();
    return () => {};
  }
  const quantity_choice = element('force'), member_choice = element('force-member'), picture = element('diagram');
  for (const { name, unit } of section_forces) quantity_choice.append(new Option(unit === '' ? name : `${name} [${unit}]`));
  for (const { name } of data.members) member_choice.append(new Option(name));
  const value_at = (force, m) => ([, , n, q, moment, A, I, EI, half]) =>
    force.of(n, q, moment, A === undefined ? data.members[m] : { ...data.members[m], A, I, EI, half });
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
      ? `Along the member, from 0 to 1: maximum ${extreme(Math.max)}, minimum ${extreme(Math.min)}.`
      : 'Not available: the section has no data for it.';
  };

  const draw_on_shape = (shape) => {
    const chosen = element('on-shape').checked;
    const longest = 9000;
    element('drawn-forces').replaceChildren(...(chosen ? shape.forces : []).flatMap((samples, m) => {
      const places = drawn_places(shape, m), value = value_at(force, m);
      if (is_hidden(m) || samples.some((sample) => value(sample) === null)) return [];
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
