// Decks whose walls are of all kinds, for pictures: an angle of two beams, and walls around it.

const closed = (name, points, more = '') => `[[wall]]
name = "${name}"
outline = { type = "polyline", points = ${JSON.stringify(points)}, closed = true${more} }
`;
const line = (name, points, type = 'polyline') => `[[wall]]
name = "${name}"
outline = { type = "${type}", points = ${JSON.stringify(points)} }
`;
const circle = (name, centre, radius, more = '') => `[[wall]]
name = "${name}"
outline = { type = "circle", centre = ${JSON.stringify(centre)}, radius = ${radius}${more} }
`;
const profile = (name, side, words) => `[[wall]]
name = "${name}"
side = "${side}"
profile = { ${words} }
`;
const moved = (wall, motion) => `${wall}motion = { ${motion} }\n`;

const walls = {
  vessel: line('lower', [[-8, -7], [-5, -5], [-3, -2.2], [0, -1], [5, -1], [10, -1], [13, 0], [15, 3], [18, 5], [22, 5.4]], 'curve') +
    line('upper', [[22, 8], [17, 7.6], [13, 6.6], [9, 5], [7.6, 2.4], [5, 1.2], [1, 1], [-2, 0.6], [-5, -1.6], [-7, -4.2], [-10, -5.6]], 'curve'),
  pegs: circle('first', [3, -0.9], 0.6) + circle('second', [6, 0.8], 0.5) + circle('third', [12, 2], 1) + circle('small', [8.5, -0.5], 0.2),
  bores: circle('bore', [5, 1], 8, ', structure = "inside"') + circle('core', [5, 3], 1.5) +
    '[[wall]]\nname = "oval"\noutline = { type = "ellipse", centre = [5.0, 1.0], axes = [7.5, 5.0], angle = 0.3, structure = "inside" }\nmembers = ["beam"]\n',
  rounded: `${line('steps', [[-2, -0.5], [2, -0.5], [3, -1.5], [5, -1.5], [6, -0.5], [8, -0.5], [9, -2], [14, -2]])}corner_radius = 0.4\n` +
    `${closed('block', [[2, 1], [6, 1], [6, 3], [2, 3]])}corner_radius = [0.2, 0.9, 0.2, 0.9]\n`,
  sharp: line('saw', [[-2, -1], [1, -1], [2, -0.4], [3, -1], [4, -0.4], [5, -1], [6, -0.4], [7, -1], [12, -1]]) +
    closed('triangle', [[3, 1], [7, 1], [5, 3]]) + closed('kite', [[11, 1], [14, 0], [15.5, 2], [12.6, 3.2]]),
  wedge: moved(closed('wedge', [[4, -3], [12, -3], [12, -0.7]]), 'x = -1.0, z = 0.3') + profile('ceiling', 'above', 'type = "flat", z = 5.0'),
  thin: line('above', [[2, -0.6], [8, -0.6]]) + `${line('below', [[8, -0.75], [2, -0.75]])}members = ["arm"]\n` +
    closed('needle', [[11, -1], [11.08, -1], [11.08, 5], [11, 5]]) + closed('blade', [[1, 0.6], [8, 1.4], [1, 0.75]]),
  crossing: circle('disc', [4, -2.5], 2) + closed('bar', [[1, -3.2], [9, -1.6], [9, -1.2], [1, -2.8]]) +
    '[[wall]]\nname = "slope"\noutline = { type = "half-plane", point = [12.0, 0.0], normal = [-1.0, 0.4] }\n' + profile('floor', 'below', 'type = "flat", z = -3.0'),
  closed: closed('room', [[-2, -2], [12, -2], [12, 6], [-2, 6]], ', structure = "inside"') +
    '[[wall]]\nname = "bean"\noutline = { type = "curve", points = [[2.0, 2.0], [4.0, 1.2], [7.0, 2.0], [6.0, 4.0], [4.5, 3.2], [2.5, 4.2]], closed = true }\n',
  open: profile('hills', 'below', 'type = "spline", points = [[0.0, -1.5], [3.0, -0.7], [6.0, -1.8], [9.0, -1.0]]') +
    profile('dome', 'above', 'type = "circle", centre = [4.0, 3.0], radius = 1.6') + profile('valley', 'below', 'type = "parabola", apex = [5.0, -3.5], curvature = 0.05'),
};

const deck = (name) => `title = "Walls: ${name}"
material.steel = { E = 1000.0 }
section.bar = { shape = "rectangle", width = 1.0, height = 0.1 }
point = { foot = [0.0, 0.0], knee = [10.0, 0.0], end = [10.0, 4.0] }
support = { foot = ["x", "z", "rotation"] }
path = { step = 0.5, max_points = 4, stop = { lambda = [-1.0, 1.0] } }
[member]
beam = { from = "foot", to = "knee", theory = "euler-bernoulli", material = "steel", section = "bar", elements = 8 }
arm = { from = "knee", to = "end", theory = "euler-bernoulli", material = "steel", section = "bar", elements = 4 }
[[load]]
at = "end"
force = [0.0, -1.0e-5]
[[monitor]]
name = "down"
at = "end"
component = "z"
${walls[name]}`;

export const wall_decks = Object.keys(walls).map((name) => ({ name, toml: deck(name) }));
