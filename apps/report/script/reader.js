// What the reader does, and how the page opens.
const on_keys = (target, keys, options = {}) => target.addEventListener('keydown', (pressed) => {
  if (pressed.ctrlKey || pressed.altKey || pressed.metaKey || !(pressed.key in keys)) return;
  pressed.preventDefault();
  keys[pressed.key](pressed);
}, options);
const step = (by) => () => { stop(); show(current + by); };
const toggle = () => playing === null ? play() : stop();
const walk = { ArrowLeft: step(-1), ArrowRight: step(1), Home: () => { stop(); show(0); },
  End: () => { stop(); show(shapes.length - 1); }, PageUp: () => go_to_event(-1), PageDown: () => go_to_event(1), ' ': toggle };

// Rows, pictures and words that stand for a point: a click, Enter or Space goes there; of a list one item is in the
// order of the Tab key, arrows lead to the others.
const make_list = (items) => items.forEach((item, i) => {
  const choose = (one) => {
    if (one.dataset.jump === undefined) return go_to(Number(one.dataset.point));
    stop();
    show_jump(Number(one.dataset.jump));
  };
  const focus = (other) => () => {
    if (!items[other]) return;
    item.tabIndex = -1;
    items[other].tabIndex = 0;
    items[other].focus();
    choose(items[other]);
  };
  item.tabIndex = i === 0 ? 0 : -1;
  item.addEventListener('click', () => choose(item));
  on_keys(item, { Enter: () => choose(item), ' ': () => choose(item), ArrowDown: focus(i + 1), ArrowRight: focus(i + 1),
    ArrowUp: focus(i - 1), ArrowLeft: focus(i - 1), Home: focus(0), End: focus(items.length - 1) });
});

if (shapes.length === 0) return null;
document.documentElement.classList.add('js');
const quantity = (key) => quantities.find((one) => one.key === key);
let axes = { across: quantity(before?.axes.across) ?? first_axes.across, up: quantity(before?.axes.up) ?? first_axes.up };
// The event that was shown, else as far along the path.
const shape_as_before = ({ event, part }) => {
  const same = event && events.filter(({ kind }) => kind === event.kind)[event.number];
  return same ? shape_near(same.point) : Math.round(part * (shapes.length - 1));
};
const asked_for = /^#point=(\d+)$/.exec(window.location.hash);  // report.html#point=30
// The event that matters: the first jump, else the first at which stability may be lost, else of a movement that with the
// greatest force, else the end.
const turning = ['limit-point', 'contact-limit-point', 'branch-point'];
const first_jump = events.find((event) => event.jumps), first_turn = events.find((event) => turning.includes(event.kind));
const force_at = ({ point }) => Math.abs(first_axes.up.values[point]);
const greatest = first_axes.across === load ? events.reduce((one, other) => force_at(other) > force_at(one) ? other : one, events[0]) : undefined;
const matters = asked_for ? Number(asked_for[1]) : (first_jump ?? first_turn ?? greatest ?? events.find(({ kind }) => kind === 'end'))?.point ?? 0;
const opening = before ? shape_as_before(before) : shape_near(matters);

if (typeof Plotly === 'undefined') {
  chart = picture_chart(go_to, axes);
} else {
  element('charts').classList.add('drawn-by-library');
  chart = plotly_chart(go_to, axes, shapes[opening].point, before?.plot, before?.keeps_axes);
  on_keys(element('plot'), walk, { signal: closing.signal });
}
show_forces = forces_panel();
hide_members(data.members.flatMap(({ name }, m) => before?.hidden.includes(name) ? [m] : []), true);
shape_tools();
show_members();
const choose_for_work = work_panel(axes);
const choices = [...quantities.slice(1, 1 + columns.length), ...(columns.length > 0 ? [quantities.find(({ key }) => key === 'arc')] : [first_across])];
if (element('up')) {
  for (const { title } of quantities) element('up').append(new Option(title));
  const there = new Set(choices);
  for (const more of quantities.filter((one) => !there.has(one))) choices.push(more);
  for (const { title } of choices.slice(element('monitor').options.length)) element('monitor').append(new Option(title));
  element('up').selectedIndex = quantities.indexOf(axes.up);
}
element('monitor').selectedIndex = Math.max(choices.indexOf(axes.across), 0);
const choose = () => {
  axes = { across: choices[element('monitor').selectedIndex], up: quantities[element('up')?.selectedIndex ?? 0] };
  chart.choose(axes.across, axes.up);
  choose_for_work(axes.across, axes.up);
};
for (const id of ['monitor', 'up']) element(id)?.addEventListener('change', choose);
element('slider').addEventListener('input', (moved) => { stop(); show(Number(moved.target.value)); });
on_keys(element('slider'), { PageUp: walk.PageUp, PageDown: walk.PageDown, ' ': toggle });
element('play').addEventListener('click', toggle);
element('event-before').addEventListener('click', () => go_to_event(-1));
element('event-after').addEventListener('click', () => go_to_event(1));
make_list([...document.querySelectorAll('#events tbody tr')]);
make_list([...document.querySelectorAll('#jumps tbody tr[data-jump]')]);
make_list([...document.querySelectorAll('#strip figure')]);
make_list([...document.querySelectorAll('.tree [data-point]')]);

// What a reader has chosen, for another run of the deck in this one's place.
const choosers = ['times', 'force', 'force-member'];
const view = () => {
  const event = events_at.get(shapes[current].point)?.[0];
  return {
    axes: { across: axes.across.key, up: axes.up.key },
    chosen: choosers.filter(element).map((id) => [id, element(id).value]),
    hidden: data.members.filter((_, m) => is_hidden(m)).map(({ name }) => name),
    event: event && { kind: event.kind, number: events.filter(({ kind }) => kind === event.kind).indexOf(event) },
    part: current / Math.max(shapes.length - 1, 1),
    walked,
  };
};
for (const [id, value] of before?.chosen ?? []) {
  const choice = element(id);
  if (!choice || choice.value === value || ![...choice.options].some((option) => option.value === value)) continue;
  choice.value = value;
  choice.dispatchEvent(new Event('change'));
}

walked = before?.walked ?? asked_for !== null;
show(opening);
return { view, curve: path_curve, draw_curve: () => chart.draw(), release_plot: () => chart.release(),
  close: () => { cancelAnimationFrame(playing); closing.abort(); } };
