// Decks whose texts try to become markup: titles, descriptions, units, file names.

const payloads = [
  '<script>window.touched = 1</script>',
  '</script><script>window.touched = 1</script>',
  '</SCRIPT ><ScRiPt>window.touched = 1</sCrIpT>',
  '</title><script>window.touched = 1</script>',
  '</style><script>window.touched = 1</script>',
  '</pre></section><script>window.touched = 1</script>',
  '</svg><img src=x onerror="window.touched = 1">',
  '<svg onload="window.touched = 1">',
  '<svg><animate onbegin="window.touched = 1" attributeName=x dur=1s>',
  '<img src=x onerror=window.touched=1>',
  '"><img src=x onerror=window.touched=1>',
  '\' onmouseover=\'window.touched = 1',
  '" autofocus onfocus="window.touched = 1',
  '` onload=`window.touched = 1',
  'x" data-point="0" tabindex="1',
  '<iframe srcdoc="<script>parent.touched = 1</script>"></iframe>',
  '<object data="data:text/html,<script>parent.touched = 1</script>">',
  '<embed src="javascript:window.touched=1">',
  '<form action="javascript:window.touched=1"><button>',
  '<math><mtext></form><form><mglyph><style></math><img src onerror=window.touched=1>',
  '<base href="https://example.org/">',
  '<meta http-equiv="refresh" content="0;url=https://example.org/">',
  '<link rel="stylesheet" href="https://example.org/x.css">',
  '<style>body { display: none }</style>',
  '<a href="javascript:window.touched=1">click</a>',
  '<b>plotly</b><br><i>markup</i><sub>x</sub><sup>y</sup>',
  '<a href="https://example.org/" target="_blank">plotly link</a>',
  '<span style="color: red; font-size: 90px">plotly span</span>',
  '&lt;img src=x onerror=window.touched=1&gt;',
  '&amp;lt;b&amp;gt; &#60;b&#62; &quot;',
  '%{x} %{customdata} %{fullData.name}<extra></extra>',
  '$\\alpha$ $$\\href{javascript:window.touched=1}{x}$$',
  '{{data}} {{script}} {{title}} }} {{',
  '${window.touched = 1} `${window.touched = 1}`',
  ']]> <![CDATA[ <script>window.touched = 1</script> ]]>',
  '<!-- <script>window.touched = 1</script> -->',
  '<!--<script>',
  '--> <script>window.touched = 1</script>',
  '\\u003cscript\\u003ewindow.touched = 1\\u003c/script\\u003e',
  '\\"};window.touched = 1;//',
  '"};window.touched = 1;//',
  '\';window.touched = 1;//',
  '*/window.touched = 1;/*',
  ')report" ")',
  '__proto__',
  'constructor',
  'toString',
  'undefined',
  'NaN',
  '\u2028window.touched = 1\u2029',
  '\u202egnp.exe\u202c',
  '\u2066\u2067\u2068\u2069\u200e\u200f',
  'أحمد <b> שלום',
  '\u0000\u0001\u0007\u0008\u001b[31m\u007f\u009b',
  '\ufeffmark',
  '\ufffe\uffff',
  '\u{1f4a3}\u{e0001}\u{10ffff}',
  'e\u0301\u0301\u0301\u0301\u0301'.repeat(30),
  'W'.repeat(10_000),
  '<b>'.repeat(3_000),
  'word '.repeat(2_000),
  '\t \n \r\n ',
  '',
  ' ',
  '/etc/passwd file:///etc/passwd',
];

const more_payloads = [
  'x<svg><script>window.touched=1<b>',
  'a" style="position:fixed;top:0;left:0;width:100vw;height:100vh" onclick="window.touched = 1',
  '<details open ontoggle=window.touched=1>',
  '<video><source onerror=window.touched=1>',
  '<template><script>window.touched = 1</script></template>',
  '<noscript><p title="</noscript><img src=x onerror=window.touched=1>">',
  '<style>@import "https://example.org/x.css";</style>',
  '=HYPERLINK("https://example.org/")',
  '<a xlink:href="javascript:window.touched=1"><text>x</text></a>',
  '<svg><foreignObject><body onload=window.touched=1></foreignObject></svg>',
  '<input autofocus onfocus=window.touched=1>',
  '<marquee onstart=window.touched=1>',
  '\u0022\u003e\u003cimg src=x onerror=window.touched=1\u003e',
  '{"title": "</script><script>window.touched = 1</script>"}',
  'javascript:window.touched=1//\u2028',
  '<x style="behavior:url(#x)" onpointerenter=window.touched=1>hover',
];

// TOML's basic strings; what may not stand in them as it is stands as an escape.
const quoted = (text) => `"${[...text].map((character) => {
  const code = character.codePointAt(0);
  if (character === '"' || character === '\\') return `\\${character}`;
  return code < 0x20 || code === 0x7f ? `\\u${code.toString(16).padStart(4, '0')}` : character;
}).join('')}"`;

const deck = ({ title, description, length, force }) => `title = ${quoted(title)}
description = ${quoted(description)}
units = { length = ${quoted(length)}, force = ${quoted(force)} }
material.steel = { E = 2.1e4 }
section.bar = { shape = "rectangle", width = 0.5, height = 0.25 }
point = { left = [-15.0, 0.0], top = [0.0, 0.6], right = [15.0, 0.0] }
support = { left = ["x", "z", "rotation"], right = ["x", "z", "rotation"] }
path = { step = 0.05, branches = "primary", max_points = 40, stop = { lambda = [-1.0, 2.0] } }
[member]
west = { from = "left", to = "top", theory = "euler-bernoulli", material = "steel", section = "bar", elements = 4 }
east = { from = "top", to = "right", theory = "euler-bernoulli", material = "steel", section = "bar", elements = 4 }
[[load]]
at = "top"
force = [0.0, -1.0]
[[wall]]
name = "floor"
side = "below"
profile = { type = "flat", z = -0.6 }
[[monitor]]
name = "down"
at = "top"
component = "z"
sign = -1
`;

// What is not cut or replaced is shown letter by letter.
const shown_as_it_is = (text) =>
  text.length < 200 && text.trim() !== '' && !/[\u0000-\u001f\u007f-\u009f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]/.test(text);

// A file may have this name.
const is_file_name = (text) => Buffer.byteLength(text) < 200 && text.trim() !== '' && !/[/\u0000\n]/.test(text);

// Decks with a text in each place: the title, both units, the description, from the command line, and, where it may be
// one, the name of the deck's file. With `all` there are more texts, each in more places, and names of tables of measured
// points besides.
export const hostile_decks = (all = false) => {
  const decks = [];
  const texts = all ? [...payloads, ...more_payloads] : payloads;
  const at = (i) => texts[i % texts.length];
  for (let i = 0; i < texts.length; i += all ? 2 : 3) {
    const name = (k, end) => (is_file_name(at(k)) ? `${i}${at(k)}${end}` : undefined);
    const file = name(i + 3, '.toml'), measured = all ? name(i + 4, '.csv') : undefined;
    decks.push({ toml: deck({ title: at(i), description: '', length: at(i + 1), force: at(i + 2) }),
      arguments: ['--set', `description=${quoted(at(i + 1))}`], file, measured,
      texts: 4 + [file, measured].filter((one) => one !== undefined).length,
      title: shown_as_it_is(at(i)) ? at(i) : undefined });
  }
  for (const file of ['<img src=x onerror=window.touched=1>.toml', '"\' onload=`x`.toml', '\u202elmot.toml', '<b>&lt;$x$.toml']) {
    decks.push({ file, toml: deck({ title: ' ', description: '', length: 'cm', force: 'kN' }), arguments: [], texts: 1 });
  }
  return decks;
};
