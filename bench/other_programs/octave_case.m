% The cases as a user of Octave writes them. Variables of the case, name and revolutions are set before this script.
1;

function dy = right_hand_side(t, y, c, in_touch)
  n = rows(c.load);
  p = y(1:n);
  v = y(n+1:2*n);
  a = c.load + c.cosine*cos(t) + c.sine*sin(t) - c.stiffness*p - c.damping*v;
  d = c.gap*p;
  r = hypot(d(1), d(2));
  if nargin < 4
    in_touch = r > 1;
  end
  if in_touch
    u = c.gap*v;
    mu = c.mu;
    if c.rim + (d(1)*u(2) - d(2)*u(1))/r < 0
      mu = -mu;
    end
    a -= (1 - 1/r)*(c.by_force*[d(1) - mu*d(2); d(2) + mu*d(1)]);
  end
  dy = [v; a];
end

function [value, stop, direction] = depth(t, y, c, in_touch)
  d = c.gap*y(1:rows(c.load));
  value = hypot(d(1), d(2)) - 1;
  stop = 1;
  direction = 1 - 2*in_touch;
end

function y = by_lsode(c, tolerance, T)
  lsode_options('relative tolerance', tolerance);
  lsode_options('absolute tolerance', tolerance);
  lsode_options('integration method', 'adams');
  lsode_options('step limit', 1e7);
  all = lsode(@(y, t) right_hand_side(t, y, c), c.start, [0 T]);
  y = all(end, :)';
end

function y = by_ode45(c, tolerance, T)
  options = odeset('RelTol', tolerance, 'AbsTol', tolerance, 'Refine', 1);
  [~, all] = ode45(@(t, y) right_hand_side(t, y, c), [0 T], c.start, options);
  y = all(end, :)';
end

function y = by_ode45_events(c, tolerance, T)
  y = c.start;
  t = 0;
  in_touch = norm(c.gap*y(1:rows(c.load))) > 1;
  while t < T
    options = odeset('RelTol', tolerance, 'AbsTol', tolerance, 'Events', @(t, y) depth(t, y, c, in_touch));
    [times, all] = ode45(@(t, y) right_hand_side(t, y, c, in_touch), [t T], y, options);
    t = times(end);
    y = all(end, :)';
    in_touch = ! in_touch;
  end
end

function report(name, program, solve, c, tolerance, revolutions)
  begin = cputime;
  y = solve(c, tolerance, 2*pi*revolutions);
  spent = cputime - begin;
  printf("%s | %s | %g | %.2e | %.5g us\n", name, program, tolerance, max(abs(y - c.finish)), 1e6*spent/revolutions);
  fflush(stdout);
end

warning('off', 'all');  % each event of ode45 is one
page_screen_output(false);
for tolerance = [1e-4 1e-6 1e-8 1e-10 1e-12 1e-13]
  report(name, 'Octave lsode', @by_lsode, c, tolerance, revolutions);
end
for tolerance = [1e-4 1e-6 1e-8 1e-10]
  report(name, 'Octave ode45', @by_ode45, c, tolerance, revolutions);
end
for tolerance = [1e-4 1e-6 1e-8]
  report(name, 'Octave ode45 events', @by_ode45_events, c, tolerance, revolutions);
end
