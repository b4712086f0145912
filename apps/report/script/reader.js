// What the reader does, and how the page opens.
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
const choose_for_work = work_panel();
const choices = [...quantities.slice(1, 1 + columns.length), ...(columns.length > 0 ? [quantities.find(({ key }) => key === 'arc')] : [first_across])];
if (element('up')) {
  for (const { title } of quantities) element('up').append(new Option(title));
  const there = new Set(choices);
  for (const more of quantities.filter((one) => !there.has(one))) choices.push(more);
  for (const { title } of choices.slice(element('monitor').options.length)) element('monitor').append(new Option(title));
}
const choose = () => {
  const across = choices[element('monitor').selectedIndex], up = quantities[element('up')?.selectedIndex ?? 0];
  chart.choose(across, up);
  choose_for_work(across, up);
};
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
