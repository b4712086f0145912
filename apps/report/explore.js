// The page of `trace-path explore`: the text of a deck that its reader changes, and the report of the run of that text.
'use strict';
(async () => {

const element = (id) => document.getElementById(id);
const made = (name, properties = {}, ...children) => {
  const one = Object.assign(document.createElement(name), properties);
  one.append(...children);
  return one;
};
const say = (text) => { element('status').textContent = text; };

const deck = await (await fetch('deck')).json();

// --- the text, and the numbers in it ---------------------------------------------------------------------------------

let text = deck.text;      // all that the reader changes
let numbers = [];          // those of `numbers_of`, each with its key, unit, value, line and column
let numbers_of = null;     // a text
let first_numbers = null;  // of the deck as it was read, by their keys
let undone = [];           // texts, the last change last
let dragged_from = null;   // the text before the drag of a slider that is under way
const shown = new Map();   // keys of sliders, in their order, with the parts of the page

// Columns count characters, as the program does.
const literal = /^[+-]?(?:inf|nan|0x[0-9a-fA-F_]+|0o[0-7_]+|0b[01_]+|[0-9][0-9_]*(?:\.[0-9_]+)?(?:[eE][+-]?[0-9_]+)?)/;
const replaced = (of, { line, column }, value) => {
  const lines = of.split('\n'), characters = [...lines[line - 1]];
  const before = characters.slice(0, column - 1).join(''), behind = characters.slice(column - 1).join('');
  const [old] = literal.exec(behind) ?? [''];
  lines[line - 1] = before + value + behind.slice(old.length);
  return { text: lines.join('\n'), longer: value.length - old.length };
};
const set_number = (number, value) => {
  const { text: changed, longer } = replaced(text, number, value);
  text = numbers_of = changed;
  number.value = Number(value);
  for (const other of numbers)
    if (other.line === number.line && other.column > number.column) other.column += longer;
  element('text').value = text;
};
const number_at = (key) => numbers_of === text ? numbers.find((number) => number.key === key) : undefined;

const remember = (before) => {
  const most = 100;
  if (undone.at(-1) !== before) undone.push(before);
  if (undone.length > most) undone.shift();
  element('undo').disabled = element('reset').disabled = false;
};
const go_back_to = (before) => {
  text = before;
  element('text').value = text;
  element('undo').disabled = undone.length === 0;
  element('reset').disabled = text === deck.text;
  trace_now();
};

// --- sliders ---------------------------------------------------------------------------------------------------------

// The range that a slider has at first, and its step: a round part of it.
const range_about = ({ value, whole }) => {
  const size = value === 0 ? 1 : Math.abs(value) / 2;
  return whole ? [value - Math.max(Math.ceil(size), 1), value + Math.max(Math.ceil(size), 1)] : [value - size, value + size];
};
const step_of = (low, high, whole) => whole ? 1 : 10 ** Math.floor(Math.log10((high - low) / 200));
const rounded = (value, step) => Number((Math.round(value / step) * step).toPrecision(12));

const add_slider = (key) => {
  const number = number_at(key);
  if (!number || shown.has(key)) return;
  const name = made('label', { textContent: key, htmlFor: `field ${key}` });
  if (number.unit !== '') name.append(made('span', { className: 'unit', textContent: ` [${number.unit}]` }));
  const field = made('input', { type: 'text', inputMode: 'decimal', id: `field ${key}` });
  const remove = made('button', { type: 'button', className: 'remove', textContent: '×', title: `Remove ${key}` });
  remove.setAttribute('aria-label', `Remove ${key}`);
  const slider = made('input', { type: 'range', step: 'any' });
  slider.setAttribute('aria-label', `${key}, slider`);
  const ends = range_about(number);
  const [low, high] = ['lowest', 'highest'].map((which, i) => {
    const end = made('input', { type: 'text', inputMode: 'decimal', value: String(rounded(ends[i], step_of(...ends, number.whole))) });
    end.setAttribute('aria-label', `${which} value of ${key}`);
    return end;
  });
  const step = () => step_of(Number(low.value), Number(high.value), number_at(key)?.whole && Number.isInteger(Number(low.value)));
  const set_ends = () => {
    if (!(Number(low.value) < Number(high.value))) return;
    [slider.min, slider.max] = [low.value, high.value];
    slider.step = String(step());
    slider.value = field.value;
  };
  const change = (value) => {
    const now = number_at(key);
    if (!now || String(now.value) === value) return;
    dragged_from ??= text;
    set_number(now, value);
    trace_next();
  };
  slider.addEventListener('input', () => {
    field.value = String(rounded(Number(slider.value), step()));
    change(field.value);
  });
  slider.addEventListener('change', () => {
    if (dragged_from !== null) remember(dragged_from);
    dragged_from = null;
    if (text === traced) report?.draw_curve();
    trace_now();
  });
  field.addEventListener('change', () => {
    if (field.value.trim() === '' || !Number.isFinite(Number(field.value))) return show_number(false);
    const was = text;
    change(String(Number(field.value)));
    dragged_from = null;
    slider.value = field.value;
    if (text !== was) remember(was);
    trace_now();
  });
  for (const end of [low, high]) end.addEventListener('change', set_ends);
  // The number as it stands in the text, or none where it does not.
  const show_number = (typing = document.activeElement === field) => {
    const now = number_at(key);
    slider.disabled = field.disabled = !now;
    if (!now) return;
    if (!typing) field.value = String(now.value);
    slider.value = String(now.value);
  };
  const box = made('div', { className: 'number' }, name, field, remove, slider, made('div', { className: 'ends' }, low, high));
  box.dataset.key = key;
  remove.addEventListener('click', () => {
    shown.delete(key);
    box.remove();
    list_keys();
  });
  const choose = (value) => {
    const was = text;
    change(value);
    dragged_from = null;
    show_number(false);
    if (text !== was) remember(was);
    trace_now();
  };
  shown.set(key, { show_number, choose, ends: () => [Number(low.value), Number(high.value)] });
  element('sliders').append(box);
  show_number();
  set_ends();
  list_keys();
};

const list_keys = () => {
  offer_curves();
  const most = 60, part = element('find').value.trim().toLowerCase();
  const all = numbers.filter(({ key }) => !shown.has(key) && key.toLowerCase().includes(part));
  element('found').replaceChildren(...all.slice(0, most).map(({ key, value, unit }) => {
    const button = made('button', { type: 'button', title: `A slider for ${key}` }, key,
      made('span', { textContent: unit === '' ? String(value) : `${value} ${unit}` }));
    button.addEventListener('click', () => {
      add_slider(key);
      element('sliders').lastElementChild?.querySelector('input[type=range]').focus();
    });
    return made('li', {}, button);
  }));
  if (all.length > most) element('found').append(made('li', { textContent: `and ${all.length - most} more; give a part of the key` }));
};

const take_numbers = (list, of) => {
  if (of === text) [numbers, numbers_of] = [list, of];
  if (first_numbers === null && of === deck.text) first_numbers = new Map(list.map((number) => [number.key, { ...number }]));
  if (shown.size === 0 && !take_numbers.once)
    for (const { key } of list) if (key.startsWith('variables.')) add_slider(key);
  take_numbers.once = true;
  for (const { show_number } of shown.values()) show_number();
  if (dragged_from === null) list_keys();  // a drag changes the number of its slider alone
};

// --- traces ----------------------------------------------------------------------------------------------------------

let running = null;  // what ends the trace that is under way, and its text
let traced = null;   // the text whose answer is shown
let last = null;     // the last answer with a page, and the report that shows it
let report = null;

const has_ended = () => { throw new Error('trace-path has ended'); };
const asked = (part, control, body) => fetch(part, { method: 'POST', body, signal: control.signal }).catch(has_ended);
const lines_of = async function* (body) {
  const decoder = new TextDecoder();
  let rest = '';
  for (const reader = body.getReader();;) {
    const { done, value } = await reader.read().catch(has_ended);
    if (done) return;
    const parts = (rest + decoder.decode(value, { stream: true })).split('\n');
    rest = parts.pop();
    yield* parts.map((line) => JSON.parse(line));
  }
};

// While a slider moves a trace that has begun goes on, so that there is something to see: the next one has the latest text.
const trace_next = () => {
  if (running === null && text !== traced) trace_text();
};
// A trace of another text is ended.
const trace_now = () => {
  if (running !== null && running.text !== text) running.control.abort();
  trace_next();
};

const trace_text = async () => {
  const of = text, control = new AbortController(), trace = { text: of, control };
  running = trace;
  const go_on = () => {
    if (running !== trace) return;
    running = null;
    if (text !== of) trace_text();
  };
  let ended = false;
  try {
    const answer = await asked('trace', control, of);
    if (!answer.ok) throw new Error(await answer.text());
    for await (const line of lines_of(answer.body)) {
      if (line.progress !== undefined) {
        element('result').classList.add('old');
        say(line.progress);
        continue;
      }
      ended = true;
      traced = of;
      go_on();  // the program traces the next text while this page draws the answer
      show_answer(line, of);
    }
    if (!ended) has_ended();
  } catch (problem) {
    if (!control.signal.aborted) say(`There is no result: ${problem.message}.`);
  }
  go_on();
};

const signals = new Map([[9, 'a limit of memory or time ended the trace'], [24, 'the limit of time ended the trace']]);
const show_answer = (answer, of) => {
  if (answer.killed !== undefined)
    return show_problems([{ line: 0, text: signals.get(answer.killed) ?? `the trace was ended by signal ${answer.killed}` }]);
  if (answer.numbers) take_numbers(answer.numbers, of);
  if (answer.errors) return show_problems(answer.errors);
  show_problems([]);
  element('warnings').replaceChildren(...answer.warnings.map((warning) => made('li', { textContent: warning })));
  last = { page: answer.page, text: of };
  show_page();
  element('result').dataset.text = of;
};

const show_problems = (problems) => {
  element('result').classList.toggle('old', problems.length > 0);
  say(problems.length === 0 ? '' : problems.length === 1 ? 'The deck has an error.' : `The deck has ${problems.length} errors.`);
  element('errors').replaceChildren(...problems.map(({ line, text: words }) => {
    const item = made('li');
    if (line > 0) {
      const button = made('button', { type: 'button', textContent: `line ${line}` });
      button.addEventListener('click', () => select_line(line));
      item.append(button, ' ');
    }
    item.append(words);
    return item;
  }));
};

const select_line = (line) => {
  const area = element('text'), lines = text.split('\n');
  const from = lines.slice(0, line - 1).join('\n').length + (line > 1 ? 1 : 0);
  element('deck-panel').open = true;
  area.focus();
  area.setSelectionRange(from, from + lines[line - 1].length);
  area.scrollTop = (line - 4) * area.scrollHeight / lines.length;
};

// The report of a run in the place of the one before. It has no scripts of its own.
const show_page = () => {
  const page = new DOMParser().parseFromString(last.page, 'text/html');
  const data = JSON.parse(page.getElementById('data').textContent);
  const before = report && { ...report.view(), plot: report.release_plot(), keeps_axes: dragged_from !== null || last.text !== text };
  report?.close();
  report = null;
  data.overlays = pins;
  document.title = page.title;
  element('result').replaceChildren(...['header', 'main'].map((part) => document.adoptNode(page.querySelector(part))));
  report = show_report(data, before);
  last.data = data;
  offer_curves();
};

// --- the load of an event over a number --------------------------------------------------------------------------------

const followed = ['limit-point', 'contact-limit-point', 'branch-point', 'turning-point', 'value-crossing', 'contact-closes',
  'contact-spreads', 'contact-shrinks'];
let following = null;  // what ends the curve under way

// The events of the first branch, by kind and number, and the numbers with sliders.
const offer_curves = () => {
  const choose_again = (select, options) => {
    const before = select.value;
    select.replaceChildren(...options.map(([value, words]) => new Option(words, value)));
    if (options.some(([value]) => value === before)) select.value = before;
  };
  const counts = new Map(), events = (last?.data.events ?? []).filter(({ point }) => last.data.points.branch[point] === 0);
  const offered = events.map(({ kind, point }) => {
    counts.set(kind, (counts.get(kind) ?? 0) + 1);
    const number = counts.get(kind);
    return { kind, rank: followed.indexOf(kind), value: `${kind} ${number}`,
      words: `${kind.replaceAll('-', ' ')}${number > 1 ? ` ${number}` : ''}, λ = ${Number(last.data.points.lambda[point].toPrecision(5))}` };
  }).filter(({ rank }) => rank >= 0).sort((a, b) => a.rank - b.rank);
  choose_again(element('curve-event'), offered.map(({ value, words }) => [value, words]));
  choose_again(element('curve-key'), [...shown.keys()].map((key) => [key, key]));
  element('follow').disabled = offered.length === 0 || shown.size === 0;
  if (following === null && shown.size === 0) element('curve-note').textContent = 'Add a slider for the number; its ends are those of the curve.';
};

// Between points whose slopes are known a cubic; at a cusp, where there is none, a straight line.
const smooth = (places) => places.flatMap(([x, y, slope], i) => {
  const next = places[i + 1], parts = 12;
  if (!next || slope === null || next[2] === null) return [[x, y]];
  return Array.from({ length: parts }, (_, k) => {
    const t = k / parts, u = 1 - t, way = next[0] - x;
    return [x + t * way, u * u * (1 + 2 * t) * y + t * t * (1 + 2 * u) * next[1] + t * u * way * (u * slope - t * next[2])];
  });
});

const draw_event_curve = ({ key, unit, points: places, specials }) => {
  const symbols = { cusp: 'diamond', crossing: 'x', begins: 'square-open', ends: 'square-open' };
  const drawn = smooth(places);
  const traces = [
    { type: 'scatter', mode: 'lines', hoverinfo: 'skip', x: drawn.map(([x]) => x), y: drawn.map(([, y]) => y), line: { color: colour('accent'), width: 2.2 } },
    { type: 'scatter', mode: 'markers', x: places.map(([x]) => x), y: places.map(([, y]) => y), marker: { color: colour('accent'), size: 5 },
      hovertemplate: `%{x}<br>λ = %{y}<extra></extra>` },
    { type: 'scatter', mode: 'markers', x: specials.map(({ point }) => places[point][0]), y: specials.map(({ point }) => places[point][1]),
      marker: { color: colour('force'), size: 11, symbol: specials.map(({ kind }) => symbols[kind]) },
      hovertext: specials.map(({ kind, why }) => `${kind}${why === '' ? '' : `: ${as_text(why)}`}`), hoverinfo: 'text' }];
  const now = number_at(key)?.value;
  const plot = element('curve-plot');
  const layout = plot_layout(plot_axis(unit === '' ? key : `${key} [${unit}]`), plot_axis('λ of the event'));
  Plotly.react(plot, traces, { ...layout, dragmode: false, margin: { ...layout.margin, t: 10 },
    shapes: now === undefined ? [] : [{ type: 'line', xref: 'x', yref: 'paper', x0: now, x1: now, y0: 0, y1: 1, line: { color: colour('force'), width: 1.2, dash: 'dot' } }] },
  { ...plot_config, displayModeBar: false });
  if (plot.choose === undefined) plot.on('plotly_click', (clicked) => plot.choose(clicked));
  plot.choose = ({ points: [{ x }] }) => shown.get(key)?.choose(String(Number(x.toPrecision(12))));
};

const follow_event = async () => {
  following?.abort();
  const control = following = new AbortController(), note = element('curve-note');
  const [kind, number] = element('curve-event').value.split(' '), parameter = element('curve-key').value;
  const [low, high] = shown.get(parameter).ends();
  let curve = null;
  note.textContent = 'tracing …';
  try {
    const answer = await asked('curve', control, JSON.stringify({ text, kind, number: Number(number), parameter, low, high }));
    if (!answer.ok) throw new Error(await answer.text());
    for await (const line of lines_of(answer.body)) {
      if (line.progress !== undefined) note.textContent = line.progress;
      if (line.errors) throw new Error(line.errors.map(({ text: words }) => words).join('; '));
      if (line.killed !== undefined) throw new Error(signals.get(line.killed) ?? `signal ${line.killed} ended it`);
      if (!line.curve) continue;
      curve = line.curve;
      draw_event_curve(curve);
      note.textContent = line.ended ? [`${curve.points.length} points; a click goes to that value.`,
        ...curve.specials.map(({ kind: special, point, why }) => `${special} at ${curve.points[point][0].toPrecision(6)}${why === '' ? '' : ` (${why})`}`)].join(' · ')
        : `${curve.points.length} points …`;
    }
  } catch (problem) {
    if (!control.signal.aborted) note.textContent = `There is no curve: ${problem.message}`;
  }
  if (following === control) following = null;
  element('curve-plot').dataset.ended = curve === null ? 'without' : 'yes';
};
element('follow').addEventListener('click', () => {
  delete element('curve-plot').dataset.ended;
  follow_event();
});

// --- pins, undo, the text, files ---------------------------------------------------------------------------------------

const pin_colours = ['#8C6BB1', '#B15928', '#7F8C3A', '#C2477F', '#4E79A7', '#999999'];
let pins = [], pinned = 0;

// The numbers that differ from the deck as it was read, as `--set` has them.
const differences = (list) => list.filter(({ key, value }) => first_numbers?.get(key)?.value !== value);
const settings = () => numbers_of === text ? differences(numbers).map(({ key, value }) => `${key}=${String(value)}`) : [];

const pin_curve = () => {
  if (last === null) return;
  const { points } = last.data;
  const firsts = points.branch.flatMap((branch, i) => i === 0 || branch !== points.branch[i - 1] ? [i] : []);
  const name = settings().join(', ') || (text === deck.text ? 'as read' : 'edited text');
  pins.push({ name: `pin ${++pinned}: ${name}`, measured: false, colour: pin_colours[(pinned - 1) % pin_colours.length], firsts, ...report.curve });
  list_pins();
};
const list_pins = () => {
  element('pins').replaceChildren(...pins.map((pin) => {
    const swatch = made('span', { className: 'swatch' }), remove = made('button', { type: 'button', textContent: '×' });
    swatch.style.borderColor = pin.colour;
    remove.setAttribute('aria-label', `Remove ${pin.name}`);
    remove.addEventListener('click', () => {
      pins = pins.filter((one) => one !== pin);
      list_pins();
    });
    return made('li', {}, swatch, made('span', { textContent: pin.name }), remove);
  }));
  if (last !== null) show_page();
};

const quoted = (word) => /^[\w.,=/+-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
// The command that traces this text, or why there is none.
const command = () => {
  if (text === deck.text) return `trace-path run ${quoted(deck.file)}`;
  let changed = deck.text;
  const by_place = numbers_of === text ? differences(numbers) : [];
  const places = by_place.flatMap(({ key, value }) => first_numbers?.has(key) ? [{ ...first_numbers.get(key), value }] : []);
  places.sort((a, b) => b.line - a.line || b.column - a.column);  // from behind: the places before stay
  for (const place of places) changed = replaced(changed, place, String(place.value)).text;
  if (changed !== text) return null;
  return `trace-path run ${quoted(deck.file)}${settings().map((setting) => ` --set ${quoted(setting)}`).join('')}`;
};

// A study of the numbers with sliders over their ranges, for `trace-path sweep plan`; null where the text has other changes
// than of numbers. Numbers that were changed without a slider have one value.
const study = () => {
  if (command() === null) return null;
  const values = 11, keys = [...shown.keys()].filter(number_at);
  const line = (key) => {
    const [low, high] = shown.get(key).ends(), { whole } = number_at(key);
    if (!whole) return `${key} = { from = ${low}, to = ${high}, count = ${values} }`;
    const step = Math.max(Math.round((high - low) / (values - 1)), 1);
    return `${key} = [${Array.from({ length: Math.floor((high - low) / step) + 1 }, (_, i) => low + i * step).join(', ')}]`;
  };
  const fixed = differences(numbers).filter(({ key }) => !shown.has(key)).map(({ key, value }) => `${key} = [${String(value)}]`);
  return [`# trace-path sweep plan ${study_file()} --out study; trace-path sweep run study; trace-path sweep collect study`,
    `title = ${JSON.stringify(`${deck.file.split('/').at(-1)}: ${keys.join(', ')}`)}`, `deck = ${JSON.stringify(deck.file.split('/').at(-1))}`, '',
    '[grid]', ...keys.map(line), ...fixed, ''].join('\n');
};
const study_file = () => deck.file.split('/').at(-1).replace(/\.toml$/, '') + '-study.toml';
const save_text = (content, name, type = 'application/toml') => {
  const link = made('a', { href: URL.createObjectURL(new Blob([content], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
};

// report.html of the run that is shown, with the pinned curves: what `run` writes carries its own scripts.
const save_report = async () => {
  if (last === null) return;
  const page = new DOMParser().parseFromString(last.page, 'text/html'), [data, ...scripts] = page.scripts, shown_data = last.data;
  const parts = ['report.css', 'plotly.js', 'report.js'].map(async (part) => (await fetch(part)).text());
  const [style, library, script] = await Promise.all(parts);
  page.querySelector('style').textContent = style;
  data.textContent = JSON.stringify(shown_data).replaceAll('<', '\\u003c');
  scripts[0].textContent = library;
  scripts[1].textContent = `${script}show_report(JSON.parse(document.getElementById('data').textContent));\n`;
  page.querySelector('.legend').append(...shown_data.overlays.map(({ name, colour: own }) => {
    const item = made('li', { textContent: name });
    item.style.color = own;
    return item;
  }));
  save_text(`<!DOCTYPE html>\n${page.documentElement.outerHTML}\n`, 'report.html', 'text/html');
};

element('undo').addEventListener('click', () => { if (undone.length > 0) go_back_to(undone.pop()); });
element('reset').addEventListener('click', () => {
  remember(text);
  go_back_to(deck.text);
});
element('pin').addEventListener('click', pin_curve);
element('find').addEventListener('input', list_keys);
element('text').addEventListener('input', () => {
  remember(text);
  text = element('text').value;
  for (const { show_number } of shown.values()) show_number();
  trace_now();
});
element('save-deck').addEventListener('click', () => save_text(text, deck.file.split('/').at(-1)));
element('save-report').addEventListener('click', save_report);
element('sweep').addEventListener('click', () => {
  const words = shown.size === 0 ? null : study();
  if (words !== null) save_text(words, study_file());
  element('copied').textContent = shown.size === 0 ? 'Add a slider for each number that the study varies.'
    : words === null ? 'The text has other changes than of numbers: save the deck, and explore that file.'
      : `Put ${study_file()} beside ${deck.file.split('/').at(-1)}: trace-path sweep plan ${study_file()} --out study`;
});
element('command').addEventListener('click', async () => {
  const words = command();
  element('copied').textContent = words ?? 'The text has other changes than of numbers: save the deck, and run that file.';
  if (words !== null) await navigator.clipboard?.writeText(words).catch(() => {});
});

// The program ends when no page is open; where it has ended, the page says so.
const open = new EventSource('open');
open.addEventListener('error', () => {
  open.close();
  say('trace-path has ended. The page still saves the deck.');
});

element('file').textContent = deck.file;
element('text').value = text;
element('undo').disabled = element('reset').disabled = true;
say('tracing …');
trace_text();
})();
