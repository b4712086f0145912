// The path as a film.
let playing = null;  // the number of the animation frame that was asked for
let walked = false;  // the reader has gone to a point; else a play begins at the first

const say_playing = (is_playing) => {
  element('play').classList.toggle('playing', is_playing);
  element('play').lastElementChild.textContent = is_playing ? 'Pause' : 'Play';
};

const stop = () => {
  walked = true;
  if (playing === null) return;
  cancelAnimationFrame(playing);
  playing = null;
  say_playing(false);
};

// The shapes of a film, by their numbers, and the jumps as { jump }. It follows a structure under its load: from a loss
// of stability to where it jumps, and from there on as the load goes on. Without jumps it is the whole path.
const film = (() => {
  const jump_at = new Map(data.jumps.flatMap(({ point, returns, shape }, number) => returns || !shape ? [] : [[point, number]]).reverse());
  if (jump_at.size === 0) return shapes.map((_, i) => i);
  const goes_on = (from, to) => shapes[to] && points.branch[shapes[from].point] === points.branch[shapes[to].point];
  // The shape behind a jump and the direction along the record in which λ goes on; null off the branches.
  const behind_jump = (number, way) => {
    const { point, behind } = data.jumps[number], { lambda } = points;
    if (behind === null) return null;
    const sense = lambda[point] - lambda[Math.max(point - way, 0)], along = lambda[behind + 1] - lambda[behind];
    const onwards = along * sense >= 0 ? 1 : -1;
    const next = onwards > 0 ? shapes.findIndex((shape) => shape.point > behind) : shapes.findLastIndex((shape) => shape.point <= behind);
    return next < 0 ? null : [next, onwards];
  };
  const scenes = [], left = new Set();
  for (let here = [0, 1]; here !== null;) {
    const [i, way] = here, number = jump_at.get(shapes[i].point);
    scenes.push(i);
    if (number === undefined) {
      here = goes_on(i, i + way) ? [i + way, way] : null;
    } else if (left.has(number)) {
      here = null;
    } else {
      left.add(number);
      scenes.push({ jump: number });
      here = behind_jump(number, way);
    }
  }
  return scenes;
})();
const show_scene = (scene) => scene.jump === undefined ? show(scene) : show_jump(scene.jump);
const scene_shown = () => film.findIndex((scene) => jumped === null ? scene === current : scene.jump === jumped);

// Of a film of so many shapes.
const seconds_of_play = (count) => Math.min(Math.max(count * 0.06, 4), 24);

const play = () => {
  const last = film.length - 1, here = scene_shown();
  const first = !walked || here < 0 || here === last ? 0 : here;
  walked = true;
  const seconds = seconds_of_play(film.length) * (last - first) / Math.max(last, 1);
  let begin = null, drawn = -1;
  const advance = (now) => {
    begin ??= now;
    const part = seconds > 0 ? Math.min((now - begin) / (1000 * seconds), 1) : 1;
    const index = first + Math.round(part * (last - first));
    if (index !== drawn) show_scene(film[index]);
    drawn = index;
    if (part < 1) playing = requestAnimationFrame(advance);
    else stop();
  };
  say_playing(true);
  playing = requestAnimationFrame(advance);
};
