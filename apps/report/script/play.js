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

// Of a film of so many shapes.
const seconds_of_play = (count) => Math.min(Math.max(count * 0.06, 4), 24);

const play = () => {
  const last = shapes.length - 1;
  const first = !walked || current === last ? 0 : current;
  walked = true;
  const seconds = seconds_of_play(shapes.length) * (last - first) / Math.max(last, 1);
  let begin = null;
  const advance = (now) => {
    begin ??= now;
    const part = seconds > 0 ? Math.min((now - begin) / (1000 * seconds), 1) : 1;
    const index = first + Math.round(part * (last - first));
    if (index !== current || part === 0) show(index);
    if (part < 1) playing = requestAnimationFrame(advance);
    else stop();
  };
  say_playing(true);
  playing = requestAnimationFrame(advance);
};
