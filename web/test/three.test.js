import assert from 'node:assert/strict';
import test from 'node:test';

import {BoxGeometry, Group, InstancedMesh, Matrix4, Mesh, SphereGeometry} from 'three';

import {JOINT_NAMES, load, NadeError} from '../dist/index.js';
import {CorrectedHand, TouchableObjects, trianglesOf} from '../dist/three.js';

const nade = await load();

/** As renderer.xr.getHand(i) is, at rest so high over the origin. */
function trackedHand(height) {
  const tracked = new Group();
  tracked.joints = {};
  tracked.set = (y) => nade.restHand('right').forEach((_, i, rest) => {
    if (i % 8 !== 0 || i === 0) return;
    const joint = tracked.joints[JOINT_NAMES[i / 8]] ??= new Group();
    joint.quaternion.fromArray(rest, i);
    joint.position.fromArray(rest, i + 4);
    joint.position.y += y;
    joint.jointRadius = 0.01;
  });
  tracked.set(height);
  return tracked;
}

test('a corrected hand has the joints and the events of three’s', () => {
  const objects = new TouchableObjects(nade);
  const table = new Mesh(new BoxGeometry(1, 0.1, 1));
  table.position.y = -0.05;
  objects.add(table);
  const tracked = trackedHand(0.2);
  const hand = new CorrectedHand(nade, tracked);
  const events = [];
  hand.addEventListener('connected', ({data}) => events.push(data.handedness));
  hand.addEventListener('disconnected', () => events.push('gone'));
  assert.equal(hand.update(objects.scene, 0), null);
  tracked.dispatchEvent({type: 'connected', data: {handedness: 'right', hand: {}}});
  for (let i = 0; i < 60; ++i) {
    objects.update();
    tracked.set(Math.max(0.001, 0.1 - 0.003 * i));
    hand.update(objects.scene, 11 * i);
  }
  assert.equal(hand.result.status, 'corrected');
  assert.equal(Object.keys(hand.joints).length, 25);
  const lifted = hand.joints['middle-finger-metacarpal'].position.y -
                 tracked.joints['middle-finger-metacarpal'].position.y;
  assert.ok(lifted > 0.005 && lifted < 0.03);
  assert.ok(hand.joints['index-finger-tip'].visible);
  assert.ok(Math.abs(hand.joints['wrist'].jointRadius - 0.01) < 1e-6);
  tracked.joints['wrist'].visible = false;
  assert.equal(hand.update(objects.scene, 1000), null);
  assert.equal(hand.visible, false);
  tracked.dispatchEvent({type: 'disconnected', data: {handedness: 'right'}});
  assert.deepEqual(events, ['right', 'gone']);
});

test('objects are where three has them, their parts and instances too', () => {
  const group = new Group();
  const part = new Mesh(new SphereGeometry(0.1, 64, 32));
  part.position.set(0, 1, 0);
  part.scale.set(-1, 1, 1);
  group.add(part);
  const many = new InstancedMesh(new SphereGeometry(0.1), undefined, 2);
  many.setMatrixAt(0, new Matrix4().makeTranslation(2, 0, 0));
  many.setMatrixAt(1, new Matrix4().makeTranslation(3, 0, 0));
  group.add(many);
  group.position.set(0, 0, 5);
  const {vertices, triangles} = trianglesOf(group);
  const surface = nade.mesh(vertices, triangles);
  const near = (x, y, z) => surface.closestPoint([x, y, z]);
  assert.ok(Math.abs(near(0, 1.2, 0).point[1] - 1.1) < 1e-4);
  assert.ok(near(0, 1.01, 0).signedDistance < 0);
  assert.ok(near(3, 0, 0).signedDistance < -0.05);
  assert.equal(surface.report.trianglesTurned, 0);
  group.scale.set(1, 2, 1);
  assert.throws(() => new TouchableObjects(nade).add(group), NadeError);
  assert.throws(() => trianglesOf(new Group()), NadeError);
});
