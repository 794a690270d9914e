// Paths and polygons of [x, y] in metres.

export function length_m(path) {
  let sum_m = 0;
  for (let i = 1; i < path.length; i += 1) sum_m += distance_m(path[i - 1], path[i]);
  return sum_m;
}

export function distance_m(a, b) {
  return Math.hypot(b[0] - a[0], b[1] - a[1]);
}

function between(a, b, share) {
  return [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])];
}

/// The path up to `at_m` and the path from there on.
export function cut(path, at_m) {
  let left_m = at_m;
  for (let i = 1; i < path.length; i += 1) {
    const leg_m = distance_m(path[i - 1], path[i]);
    if (left_m < leg_m) {
      const corner = between(path[i - 1], path[i], left_m / leg_m);
      return [[...path.slice(0, i), corner], [corner, ...path.slice(i)]];
    }
    left_m -= leg_m;
  }
  return [path.slice(), path.slice(-1)];
}

/// Arrow heads every `step_m` along the path, `size_m` long: three corners each.
export function arrows_along(path, step_m, size_m) {
  const arrows = [];
  let next_m = step_m / 2;
  for (let i = 1; i < path.length; i += 1) {
    const leg_m = distance_m(path[i - 1], path[i]);
    for (; next_m < leg_m; next_m += step_m) {
      arrows.push(arrow_at(between(path[i - 1], path[i], next_m / leg_m), direction(path[i - 1], path[i]), size_m));
    }
    next_m -= leg_m;
  }
  return arrows;
}

function direction(a, b) {
  return Math.atan2(b[1] - a[1], b[0] - a[0]);
}

function arrow_at([x, y], heading_rad, size_m) {
  const along = [Math.cos(heading_rad), Math.sin(heading_rad)];
  const corner = (forward, left) => [
    x + size_m * (forward * along[0] - left * along[1]), y + size_m * (forward * along[1] + left * along[0])];
  return [corner(0.6, 0), corner(-0.45, 0.42), corner(-0.2, 0), corner(-0.45, -0.42)];
}

export function area_m2(polygon) {
  let twice = 0;
  polygon.forEach((a, i) => {
    const b = polygon[(i + 1) % polygon.length];
    twice += a[0] * b[1] - a[1] * b[0];
  });
  return Math.abs(twice) / 2;
}

export function box_of(polygon) {
  const xs = polygon.map((corner) => corner[0]);
  const ys = polygon.map((corner) => corner[1]);
  const x_m = Math.min(...xs);
  const y_m = Math.min(...ys);
  return { x_m, y_m, width_m: Math.max(...xs) - x_m, height_m: Math.max(...ys) - y_m };
}

export function rectangle(box) {
  const { x_m, y_m, width_m, height_m } = box;
  return [[x_m, y_m], [x_m + width_m, y_m], [x_m + width_m, y_m + height_m], [x_m, y_m + height_m]];
}

export function is_rectangle(polygon) {
  if (polygon.length !== 4) return false;
  const { x_m, y_m, width_m, height_m } = box_of(polygon);
  const on_edge = (value, low, size) => Math.abs(value - low) < 1e-6 || Math.abs(value - low - size) < 1e-6;
  return polygon.every(([x, y]) => on_edge(x, x_m, width_m) && on_edge(y, y_m, height_m)) &&
    Math.abs(area_m2(polygon) - width_m * height_m) < 1e-6;
}

/// The polygon stretched from its box to another one.
export function fit_into(polygon, box) {
  const old = box_of(polygon);
  const stretch = (value, low, size, new_low, new_size) => new_low + (size > 0 ? (value - low) / size : 0) * new_size;
  return polygon.map(([x, y]) => [
    stretch(x, old.x_m, old.width_m, box.x_m, box.width_m), stretch(y, old.y_m, old.height_m, box.y_m, box.height_m)]);
}

/// Moved by dx, dy, but not over the edge of the map.
export function moved(polygon, dx_m, dy_m, map) {
  const box = box_of(polygon);
  const keep = (shift, low, size, whole) => Math.min(Math.max(shift, -low), whole - low - size);
  const x_m = keep(dx_m, box.x_m, box.width_m, map.width_m);
  const y_m = keep(dy_m, box.y_m, box.height_m, map.height_m);
  return polygon.map(([x, y]) => [x + x_m, y + y_m]);
}

/// To 5 cm, on the map: as fine as a finger can mean it.
export function snapped([x, y], map) {
  const snap = (value, whole) => Math.min(Math.max(Math.round(value * 20) / 20, 0), whole);
  return [snap(x, map.width_m), snap(y, map.height_m)];
}

export function contains(polygon, [x, y]) {
  let inside = false;
  polygon.forEach((a, i) => {
    const b = polygon[(i + 1) % polygon.length];
    if (a[1] > y !== b[1] > y && x < a[0] + ((y - a[1]) * (b[0] - a[0])) / (b[1] - a[1])) inside = !inside;
  });
  return inside;
}

const kLookEvery_m = 0.1;

/// Of a path's length, as good as to a percent.
export function share_inside(path, polygons) {
  const all_m = length_m(path);
  let inside_m = 0;
  for (let i = 1; i < path.length; i += 1) {
    const leg_m = distance_m(path[i - 1], path[i]);
    const looks = Math.ceil(leg_m / kLookEvery_m);
    for (let k = 0; k < looks; k += 1) {
      const place = between(path[i - 1], path[i], (k + 0.5) / looks);
      if (polygons.some((polygon) => contains(polygon, place))) inside_m += leg_m / looks;
    }
  }
  return all_m > 0 ? inside_m / all_m : 0;
}

function turn(a, b, c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

function cross(a, b, c, d) {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

/// At least three corners, some area, and a border that does not cross itself.
export function is_simple(polygon) {
  const n = polygon.length;
  if (n < 3 || area_m2(polygon) < 0.01) return false;
  for (let i = 0; i < n; i += 1) {
    for (let j = i + 1; j < n; j += 1) {
      if (cross(polygon[i], polygon[(i + 1) % n], polygon[j], polygon[(j + 1) % n])) return false;
    }
  }
  return true;
}
