% Lee's frame with Octave, as one would write it there: all elements at once, one sparse solution an iteration.
%
%   octave-cli --no-gui lee_octave.m ELEMENTS
%
% The same elements, metric and steps as chain_yardstick.cpp; prints figures as that does.
1;

function angle = wrapped(angle)
  angle -= 2 * pi * round(angle / (2 * pi));
end

function frame = lee_frame(elements)
  side = 120;
  column = floor(elements / 2);
  beam = elements - column;
  e = (0:elements - 1)';
  frame.EA = 4320;
  frame.EI = 1440;
  frame.elements = elements;
  frame.size = 3 * (elements + 1);
  frame.loaded = 3 * (column + floor(beam / 5)) + 2;
  frame.dx0 = (e >= column) * side / beam;
  frame.dz0 = (e < column) * side / column;
  frame.length = hypot(frame.dx0, frame.dz0);
  frame.unknowns = 3 * e + (1:6);
  frame.pins = [1, 2, frame.size - 2, frame.size - 1];
  frame.load = zeros(frame.size, 1);
  frame.load(frame.loaded) = -1;
  [j, i] = meshgrid(1:6, 1:6);
  frame.i = i(:)';
  frame.j = j(:)';
  frame.rows = frame.unknowns(:, frame.i);
  frame.columns = frame.unknowns(:, frame.j);
  held = false(frame.size, 1);
  held(frame.pins) = true;
  frame.held = held(frame.rows) | held(frame.columns);
  frame.unit_rows = sparse(frame.pins, frame.pins, 1, frame.size, frame.size);
end

% Columns of x: -K⁻¹ F and -K⁻¹ F_λ.
function x = line_of(frame, u, lambda)
  q = reshape(u(frame.unknowns), [], 6);
  dx = frame.dx0 + q(:, 4) - q(:, 1);
  dz = frame.dz0 + q(:, 5) - q(:, 2);
  L0 = frame.length;
  L = hypot(dx, dz);
  c = dx ./ L;
  s = dz ./ L;
  one = ones(size(L));
  zero = zeros(size(L));
  turn = atan2(frame.dx0 .* s - frame.dz0 .* c, frame.dx0 .* c + frame.dz0 .* s);
  t1 = wrapped(q(:, 3) - turn);
  t2 = wrapped(q(:, 6) - turn);
  k = 2 * frame.EI ./ L0;
  M1 = k .* (2 * t1 + t2);
  M2 = k .* (t1 + 2 * t2);
  N = frame.EA * (L .^ 2 - L0 .^ 2) ./ ((L + L0) .* L0);
  h = (M1 + M2) ./ L .^ 2;
  r = [-c, -s, zero, c, s, zero];
  z = [s, -c, zero, -s, c, zero];
  b1 = [-s ./ L, c ./ L, one, s ./ L, -c ./ L, zero];
  b2 = [-s ./ L, c ./ L, zero, s ./ L, -c ./ L, one];
  force = N .* r + M1 .* b1 + M2 .* b2;
  i = frame.i;
  j = frame.j;
  values = (frame.EA ./ L0) .* r(:, i) .* r(:, j) + (N ./ L) .* z(:, i) .* z(:, j) ...
           + h .* (r(:, i) .* z(:, j) + z(:, i) .* r(:, j)) ...
           + k .* (2 * b1(:, i) .* b1(:, j) + b1(:, i) .* b2(:, j) + b2(:, i) .* b1(:, j) + 2 * b2(:, i) .* b2(:, j));
  values(frame.held) = 0;
  K = sparse(frame.rows(:), frame.columns(:), values(:), frame.size, frame.size) + frame.unit_rows;
  F = accumarray(frame.unknowns(:), force(:), [frame.size, 1]) - lambda * frame.load;
  F(frame.pins) = 0;
  x = K \ [-F, frame.load];
end

function [steps, iterations, limit] = trace(frame)
  weight = 1 / (frame.elements + 1) / 120 ^ 2;
  u = last = zeros(frame.size, 1);
  lambda = 0;
  last_lambda = 1;
  radius = 0.005;
  steps = 0;
  iterations = 1;
  limit = 0;
  turned = false;
  x = line_of(frame, u, lambda);
  while -u(frame.loaded) < 90
    along = x(:, 2);
    sense = 1 - 2 * (weight * (along' * last) + last_lambda < 0);
    tangent_lambda = sense / sqrt(weight * (along' * along) + 1);
    tangent = tangent_lambda * along;
    from = u;
    from_lambda = lambda;
    arrived = false;
    while !arrived
      u = from + radius * tangent;
      lambda = from_lambda + radius * tangent_lambda;
      for used = 1:8
        x = line_of(frame, u, lambda);
        iterations++;
        across = weight * tangent' * x;
        dlambda = -across(1) / (across(2) + tangent_lambda);
        step = x(:, 1) + dlambda * x(:, 2);
        u += step;
        lambda += dlambda;
        distance = sqrt(weight * (step' * step) + dlambda ^ 2);
        arrived = distance < 1e-8;
        if arrived || !(distance < 1)
          break;
        end
      end
      if !arrived
        radius *= 0.5;
      end
    end
    steps++;
    last = u - from;
    last_lambda = lambda - from_lambda;
    turned = turned || last_lambda < 0;
    if !turned
      limit = lambda;
    end
    if used <= 3
      radius = min(1.5 * radius, 0.05);
    elseif used > 5
      radius *= 0.7;
    end
  end
end

warning("off", "Octave:nearly-singular-matrix");
elements = str2double(argv(){1});
frame = lee_frame(elements);
start = cputime();
[steps, iterations, limit] = trace(frame);
used = cputime() - start;
printf("lee,%d,path,s,%.10g\n", elements, used);
printf("lee,%d,points,,%d\n", elements, steps);
printf("lee,%d,iterations,,%d\n", elements, iterations);
printf("lee,%d,first limit,kN,%.10g\n", elements, limit);
printf("lee,%d,per iteration and element,us,%.10g\n", elements, 1e6 * used / (iterations * elements));
