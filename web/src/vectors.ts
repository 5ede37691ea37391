/** Vectors x y z and quaternions x y z w, as plain numbers. */

export type Vector = [number, number, number];
export type Quaternion = [number, number, number, number];

export const plus = (a: Vector, b: Vector): Vector => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const minus = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const times = (s: number, a: Vector): Vector => [s * a[0], s * a[1], s * a[2]];
export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a: Vector): number => Math.hypot(a[0], a[1], a[2]);
export const unit = (a: Vector): Vector => times(1 / length(a), a);
/** What of `a` is along the surface of that normal. */
export const along = (a: Vector, normal: Vector): Vector => minus(a, times(dot(a, normal), normal));
/** Some unit vector across. */
export const across = (a: Vector): Vector =>
  unit(cross(a, Math.abs(a[0]) < 0.7 ? [1, 0, 0] : [0, 1, 0]));

export const turn = (angle: number, axis: Vector): Quaternion =>
  [...times(Math.sin(angle / 2), axis), Math.cos(angle / 2)];
export const multiply = (a: Quaternion, b: Quaternion): Quaternion => [
  a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
  a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
  a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
  a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]];
export const inverse = (a: Quaternion): Quaternion => [-a[0], -a[1], -a[2], a[3]];
export const rotate = (q: Quaternion, a: Vector): Vector => {
  const axis: Vector = [q[0], q[1], q[2]];
  const twice = times(2, cross(axis, a));
  return plus(plus(a, times(q[3], twice)), cross(axis, twice));
};
/** The rotation that has these as its axes, which are unit and across each other. */
export const fromAxes = (x: Vector, y: Vector, z: Vector): Quaternion => {
  const trace = x[0] + y[1] + z[2];
  const q: Quaternion = trace > 0 ?
    [y[2] - z[1], z[0] - x[2], x[1] - y[0], 1 + trace] :
    x[0] > y[1] && x[0] > z[2] ?
    [1 + x[0] - y[1] - z[2], x[1] + y[0], z[0] + x[2], y[2] - z[1]] :
    y[1] > z[2] ?
    [x[1] + y[0], 1 + y[1] - x[0] - z[2], y[2] + z[1], z[0] - x[2]] :
    [z[0] + x[2], y[2] + z[1], 1 + z[2] - x[0] - y[1], x[1] - y[0]];
  const norm = Math.hypot(...q);
  return [q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm];
};
