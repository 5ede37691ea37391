import assert from 'node:assert/strict';
import test from 'node:test';

import {Bone, BoxGeometry, BufferAttribute, Group, InstancedMesh, Matrix4, Mesh, Skeleton,
        SkinnedMesh, SphereGeometry, Vector3} from 'three';

import {JOINT_NAMES, load, NadeError} from '../dist/index.js';
import {CorrectedHand, FlattenedSkin, TouchableObjects, trianglesOf} from '../dist/three.js';
import {handModel} from './hand_model.js';
import {randomNumbers} from './strokes.js';

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

/** The lowest vertex of a mesh, as three draws it. */
const lowest = (mesh) => {
  const heights = Array.from({length: mesh.geometry.getAttribute('position').count},
                             (_, i) => mesh.getVertexPosition(i, new Vector3()).y);
  return Math.min(...heights);
};

/** As it is drawn once it has come down onto y = 0. */
function pressedHand(side, table) {
  const corrector = nade.corrector();
  let drawn;
  for (let i = 0; i <= 60; ++i) {
    const height = Math.max(0.001, 0.1 - 0.003 * i);
    const hand = nade.restHand(side).map((x, k) => (k % 8 === 5 ? x + height : x));
    drawn = corrector.update(side, hand, table, 11 * i).joints;
  }
  return drawn;
}

test('flattened skin is the skinned mesh’s own, but where it is sunk', () => {
  const table = nade.plane();
  for (const side of ['left', 'right']) {
    const {model, mesh, bones} = handModel(side);
    const skin = new FlattenedSkin(nade, mesh, side);
    assert.equal(mesh.visible, false);
    const hand = pressedHand(side, table);
    bones.forEach((bone) => {
      const at = 8 * JOINT_NAMES.indexOf(bone.name);
      bone.quaternion.fromArray(hand, at);
      bone.position.fromArray(hand, at + 4);
    });
    model.updateMatrixWorld(true);
    mesh.skeleton.update();
    skin.update(hand, null);
    const {position, normal, uv} = skin.geometry.attributes;
    for (let i = 0; i < position.count; ++i) {
      const drawn = mesh.getVertexPosition(i, new Vector3());
      assert.ok(drawn.distanceTo(new Vector3().fromBufferAttribute(position, i)) < 1e-5);
    }
    assert.equal(uv, mesh.geometry.attributes.uv);
    assert.ok(lowest(mesh) < -0.002);
    const before = position.array.slice();
    skin.update(hand, table);
    assert.ok(lowest(skin) > 0.00015, `${lowest(skin)} m`);
    position.array.forEach((y, i) => {
      const vertex = i - i % 3;
      if (before[vertex + 1] > 0.00201) assert.equal(y, before[i]);
      else if (before[vertex + 1] < -0.0005) assert.ok(normal.array[vertex + 1] < -0.5);
    });
    skin.destroy();
    assert.equal(mesh.visible, true);
  }
  const {mesh} = handModel('right');
  mesh.skeleton.bones[3].name = 'elbow';
  assert.throws(() => new FlattenedSkin(nade, mesh, 'right'), /expected a bone for each joint/);
});

test('a corrected hand flattens the skin of the model in it, as long as that is there', (t) => {
  const objects = new TouchableObjects(nade);
  const table = new Mesh(new BoxGeometry(1, 0.003, 1));  // a board of 3 mm
  table.position.y = -0.0015;
  objects.add(table);
  const tracked = trackedHand(0.2);
  const hand = new CorrectedHand(nade, tracked);
  const plain = new CorrectedHand(nade, tracked, {flatten: false});
  const {model, mesh} = handModel('right');
  const other = handModel('right');
  tracked.dispatchEvent({type: 'connected', data: {handedness: 'right', hand: {}}});
  const times = [];
  for (let i = 0; i < 120; ++i) {
    if (i === 20) {  // loaded by then
      hand.add(model);
      plain.add(other.model);
    }
    objects.update();
    tracked.set(Math.max(0.001, 0.1 - 0.003 * i));
    const start = process.hrtime.bigint();
    hand.update(objects.scene, 11 * i);
    if (i > 60) times.push(Number(process.hrtime.bigint() - start) / 1e6);
    plain.update(objects.scene, 11 * i);
  }
  const skin = hand.children.find((child) => child instanceof FlattenedSkin);
  assert.equal(skin.original, mesh);
  assert.ok(lowest(skin) > -0.0002, `${lowest(skin)} m`);
  assert.ok(other.mesh.visible);
  times.sort((a, b) => a - b);
  t.diagnostic(`corrected and flattened in ${times[times.length >> 1].toFixed(2)} ms a hand`);
  hand.remove(model);
  hand.update(objects.scene, 2000);
  assert.equal(mesh.visible, true);
  assert.ok(!hand.children.includes(skin));
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

/** A ball with two bones and two morph targets, of so many vertices. */
function livingBall(columns, rows) {
  const geometry = new SphereGeometry(0.1, columns, rows);
  const {count} = geometry.getAttribute('position');
  const random = randomNumbers(17);
  const weights = Array.from({length: count}, () => 0.5 + 0.5 * random());
  const four = (Kind, use) => new BufferAttribute(new Kind(weights.flatMap(use)), 4);
  geometry.setAttribute('skinIndex', four(Uint16Array, () => [0, 1, 0, 0]));
  geometry.setAttribute('skinWeight', four(Float32Array, (w) => [w, 1 - w, 0, 0]));
  geometry.morphAttributes.position = [0, 1].map(() => new BufferAttribute(
    Float32Array.from({length: 3 * count}, () => 0.02 * random()), 3));
  geometry.morphTargetsRelative = true;
  const mesh = new SkinnedMesh(geometry);
  const bones = [new Bone(), new Bone()];
  bones[0].add(bones[1]);
  bones[1].position.set(0, 0.05, 0);
  const group = new Group();
  group.add(mesh, bones[0]);
  group.updateMatrixWorld(true);
  mesh.bind(new Skeleton(bones));
  mesh.updateMorphTargets();
  return {group, mesh, bones};
}

test('vertices are where three draws them, with bones and morph targets', () => {
  const {group, mesh, bones} = livingBall(32, 16);
  group.position.set(1, 2, 3);
  group.rotation.set(0.3, 0.4, 0.5);
  mesh.position.set(0.1, 0, 0);
  bones[0].rotation.z = 0.7;
  bones[1].rotation.x = 1.1;
  mesh.morphTargetInfluences = [0.3, 0.9];
  for (const [mode, relative] of [['attached', true], ['detached', true], ['attached', false]]) {
    mesh.bindMode = mode;
    mesh.geometry.morphTargetsRelative = relative;
    const {vertices} = trianglesOf(group);
    group.updateMatrixWorld(true);
    mesh.skeleton.update();
    for (let i = 0; i < vertices.length / 3; ++i) {
      const drawn = mesh.getVertexPosition(i, new Vector3()).applyMatrix4(mesh.matrixWorld);
      const found = group.localToWorld(new Vector3().fromArray(vertices, 3 * i));
      assert.ok(drawn.distanceTo(found) < 1e-6, `${mode}, ${relative}: ${drawn.distanceTo(found)}`);
    }
  }
});

test('what bones and morph targets move is followed', (t) => {
  const {group, mesh, bones} = livingBall(200, 130);
  const objects = new TouchableObjects(nade);
  objects.add(group);
  const corrector = nade.corrector();
  const hand = nade.restHand('right');
  const heights = [];
  const times = [];
  for (let i = 0; i <= 60; ++i) {
    if (i > 30) bones[0].position.y = 0.001 * (i - 30);
    const start = process.hrtime.bigint();
    objects.update();
    if (i > 30) times.push(Number(process.hrtime.bigint() - start) / 1e6);
    const lowered = hand.map((x, k) => (k % 8 === 5 ? x + 0.1 + Math.max(0, 0.03 - 0.001 * i) : x));
    const {joints} = corrector.update('right', lowered, objects.scene, 11 * i);
    heights.push(joints[5] - lowered[5]);
  }
  const rise = heights[60] - heights[30];
  assert.ok(rise > 0.02, `${rise} m`);
  times.sort((a, b) => a - b);
  t.diagnostic(`${times[15].toFixed(1)} ms a frame for ` +
               `${mesh.geometry.getAttribute('position').count} vertices`);
  objects.remove(group);
  assert.equal(objects.scene.size, 0);
});
