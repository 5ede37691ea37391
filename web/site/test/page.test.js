import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import test, {after, before} from 'node:test';
import {gunzipSync, gzipSync} from 'node:zlib';

import {load} from '../../dist/index.js';
import {built, CUBE, frames, glb, headset, openBrowser, until} from './browser.js';

const MOST_MS = 2;
const [LEAST_FRAMES, MOST_FRAMES] = [60, 300];
/** Skin is drawn flat where it is sunk, to a millimetre. */
const FLAT_M = 0.001;
const FINGERS = ['index', 'middle', 'ring', 'pinky'];
const nade = await load();
let browser;
/** One page for what a visitor does in any order: opening it takes longest. */
let visit;
before(async () => {
  browser = await openBrowser();
  visit = await browser.open();
});
after(async () => { await browser.close(); });

const choose = (page, set, value) => page.check(`#${set} [value=${value}]`);
const skin = (page, side = 'right') => page.evaluate((s) => window.nadePage.skin(s), side);
const hand = (page, side = 'right') => page.evaluate((s) => window.nadePage.hand(s), side);
/** Waits for a sentence; it is still there once it is hidden again. */
const said = (page, sentence) => until(page, (source) => (
  new RegExp(source).test(document.querySelector('#notice').textContent)), sentence.source);
const palm = ({drawn}) => drawn.slice(4, 7);
const distance = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));
const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];

/** The skin is out of the object. */
function liesOut(found) {
  for (const [joint, away] of Object.entries(found)) {
    assert.ok(away > -FLAT_M, `${joint}: ${(1000 * away).toFixed(1)} mm`);
  }
}

/** The palm and so many fingers touch. Where the object curves away, fingers reach beyond it. */
const liesOn = (page, count) => until(page, ([fingers, least]) => {
  const found = window.nadePage.skin('right');
  const tips = fingers.map((finger) => found[`${finger}-finger-phalanx-distal`]);
  const palmar = fingers.map((finger) => found[`${finger}-finger-metacarpal`]);
  return tips.filter((away) => away < 0.004).length >= least &&
         palmar.filter((away) => away < 0.002).length >= 2;
}, [FINGERS, count]);

test('a mouse strokes the dog: the hand is out of it, and on it', async () => {
  const {page, picture} = visit;
  for (let i = 0; i <= 20; ++i) {
    await page.mouse.move(480 + 6 * i, 420);
    await frames(page, 1);
    if (i % 10 === 0) liesOut(await skin(page));
  }
  await liesOn(page, 2);
  assert.equal((await hand(page)).status, 'corrected');
  liesOut(await skin(page));
  await picture('mouse');
  await choose(page, 'methods', 'none');
  await page.check('[name=ghost]');
  await until(page, () => Math.min(...Object.values(window.nadePage.skin('right'))) < -0.018);
  await choose(page, 'methods', 'nade');
  await until(page, (least) => Math.min(...Object.values(window.nadePage.skin('right'))) > least, -FLAT_M);
  await page.uncheck('[name=ghost]');
  await choose(page, 'objects', 'plane');
  await liesOn(page, 4);
  liesOut(await skin(page));
  await choose(page, 'objects', 'dog');
});

test('the dog breathes, and the hand stays on it', async (t) => {
  const {page, picture} = visit;
  await page.mouse.move(600, 420);
  await page.check('[name=alive]');
  await frames(page, 25);
  const heights = [];
  for (let i = 0; i < 5; ++i) {
    await frames(page, 6);
    const found = await skin(page);
    liesOut(found);
    heights.push(palm(await hand(page)));
  }
  assert.ok(heights.some((at) => distance(at, heights[0]) > 0.001));
  const refitMs = await page.evaluate(() => window.nadePage.refitMs());
  t.diagnostic(`refitted in ${refitMs.toFixed(1)} ms`);
  assert.match(await page.textContent('#moment'), /refit/);
  await picture('breathing');
  await page.uncheck('[name=alive]');
});

test('a replay plays, pauses, goes as slowly as asked, and takes recordings of one’s own', async () => {
  const {page, picture} = visit;
  const replay = () => page.evaluate(() => window.nadePage.replay());
  const scrub = (share) => page.locator('#time').evaluate((slide, to) => {
    slide.value = to;
    slide.dispatchEvent(new Event('input'));
  }, String(share));
  await choose(page, 'sources', 'replay');
  await until(page, () => window.nadePage.replay()?.time > 0.1);
  await scrub(0.5);
  assert.equal((await replay()).playing, false);
  await until(page, () => window.nadePage.hand('right')?.status === 'corrected');
  await frames(page, 12);
  liesOut(await skin(page));
  const at = (await replay()).time;
  await frames(page, 6);
  assert.equal((await replay()).time, at);
  await picture('replay');
  await page.click('#play');
  await until(page, (before) => window.nadePage.replay().time > before, at);

  const lines = gunzipSync(readFileSync(join(built, 'stroke.jsonl.gz'))).toString().split('\n');
  lines[0] = '{"format":"nade-recording","version":1}';
  const file = (name, text) => ({name, mimeType: '', buffer: Buffer.from(text)});
  await choose(page, 'objects', 'ball');
  await page.setInputFiles('#own', file('mine.jsonl.gz', gzipSync(lines.slice(0, 61).join('\n'))));
  await until(page, () => window.nadePage.replay()?.seconds < 2);
  await until(page, () => window.nadePage.hand('right')?.status === 'corrected');
  await frames(page, 8);
  liesOut(await skin(page));
  await page.setInputFiles('#own', file('broken.jsonl', `${lines[0]}\n{"t":"?"}\n{}\n`));
  await said(page, /^broken\.jsonl: line 2: t: expected a number/);
  assert.ok(await replay());
  await choose(page, 'objects', 'dog');
  await choose(page, 'sources', 'pointer');
});

test('objects of one’s own: good, broken and huge', async () => {
  const {page, picture} = visit;
  const file = (name, buffer) => ({name, mimeType: 'model/gltf-binary', buffer});
  await page.evaluate((bytes) => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([Uint8Array.from(bytes)], 'cube.glb'));
    window.dispatchEvent(new DragEvent('drop', {dataTransfer}));
  }, [...glb(...CUBE)]);
  await until(page, () => document.querySelector('#objects [value=own]')?.checked);
  await page.mouse.move(640, 360);
  await until(page, () => window.nadePage.hand('right')?.status === 'corrected');
  await frames(page, 12);
  liesOut(await skin(page));
  await picture('own');
  await page.setInputFiles('#own', file('text.glb', Buffer.from('no model at all')));
  await said(page, /^text\.glb: expected a GLB file/);
  await page.setInputFiles('#own', file('cut.glb', glb(...CUBE).subarray(0, 700)));
  await said(page, /^cut\.glb: expected a GLB/);
  await page.setInputFiles('#own', file('empty.glb', glb([0, 0, 0, 0, 0, 0, 0, 0, 0], [0, 1, 2])));
  await said(page, /^empty\.glb: has no triangles/);
  const many = new Uint32Array(3 * 1000001).map((_, i) => CUBE[1][i % 36]);
  await page.setInputFiles('#own', file('huge.glb', glb(CUBE[0], many)));
  await said(page, /^huge\.glb: has 1000001 triangles/);
  assert.equal((await hand(page)).status, 'corrected');
  await choose(page, 'objects', 'dog');
});

test('a camera: asked for, loaded only then, a hand of a film, and gone again', async (t) => {
  const {page, requests, picture} = visit;
  const loaded = () => requests.filter((url) => url.includes('/mediapipe/')).length;
  await choose(page, 'sources', 'camera');
  assert.match(await page.textContent('#consent'), /pictures stay on this machine/);
  await picture('camera-consent');
  await page.click('#consent [value=no]');
  await until(page, () => document.querySelector('#sources [value=pointer]').checked);
  assert.equal(loaded(), 0);
  await choose(page, 'sources', 'camera');
  await page.click('#consent [value=yes]');
  await until(page, () => window.nadePage.camera()?.seen.right && window.nadePage.hand('right'));
  assert.ok(loaded() > 0);
  await until(page, () => /right hand/.test(document.querySelector('#moment').textContent));
  const first = palm(await until(page, () => window.nadePage.hand('right')));
  await until(page, (before) => {
    const drawn = window.nadePage.hand('right')?.drawn;
    return drawn && Math.hypot(drawn[4] - before[0], drawn[6] - before[2]) > 0.02;
  }, first);
  // A busy machine sees few of the film's pictures, between which the hand leaps.
  await until(page, (least) => window.nadePage.hand('right')?.status === 'corrected' &&
    Math.min(...Object.values(window.nadePage.skin('right'))) > least, -FLAT_M);
  await picture('camera');
  t.diagnostic(`MediaPipe: ${(await page.evaluate(() => window.nadePage.camera().spentMs)).toFixed(0)} ms`);
  await choose(page, 'sources', 'pointer');
  await until(page, () => document.querySelector('#video').srcObject === null);
});

// What comes then has the machine to itself.
test('none of all that asked anything of anybody else, or was an error', () => visit.done());

test('a headset: both hands, lost and found, and a panel to touch', async (t) => {
  const {page, picture, done} = await browser.open({viewport: {width: 400, height: 300}, script: headset});
  assert.ok(await page.isHidden('#no-headset'));
  await page.press('text=Enter VR', 'Enter');
  await until(page, () => window.nadePage.tableMatrix());
  const rest = {left: nade.restHand('left'), right: nade.restHand('right')};
  const put = (side, x, y, z) => page.evaluate(([s, joints]) => window.inject(s, joints), [
    side, [...rest[side].map((v, i) => v + ([0, 0, 0, 0, x, y, z, 0][i % 8]))]]);
  for (let i = 0; i <= 12; ++i) {
    await put('right', 0.04, 0.52 - 0.007 * i, 0);
    await put('left', -0.3, 0.08 - 0.008 * i, 0.15);
    await frames(page, 1);
  }
  await until(page, () => window.nadePage.hand('left') && window.nadePage.hand('right'));
  await frames(page, 12);
  await picture('headset');
  const [left, right] = [await hand(page, 'left'), await hand(page)];
  assert.equal(right.status, 'corrected');
  assert.equal(left.status, 'corrected');
  assert.ok(left.tracked[5] < -0.01 && left.drawn[5] > 0.01, 'the left hand lies on the table');
  liesOut(await skin(page));

  await page.evaluate(() => { window.hidden = 'index-finger-tip'; });
  await until(page, () => !window.nadePage.hand('right') && !window.nadePage.hand('left'));
  await page.evaluate(() => { window.hidden = null; });
  await until(page, () => window.nadePage.hand('right') && window.nadePage.hand('left'));
  await page.evaluate(() => { window.device.hands.left.connected = false; });
  await until(page, () => !window.nadePage.hand('left') && window.nadePage.hand('right'));
  await page.evaluate(() => { window.device.hands.left.connected = true; });
  await until(page, () => window.nadePage.hand('left'));

  await page.evaluate(() => window.nadePage.spent());
  // What else the machine does only adds to a time: of many frames the quickest counts.
  const spent = [];
  const quickest = () => Math.min(...spent.map(({allMs}) => allMs));
  while (spent.length < LEAST_FRAMES || (quickest() >= MOST_MS && spent.length < MOST_FRAMES)) {
    spent.push(...await page.evaluate(() => window.nadePage.spent()));
  }
  const [corrects, all] = ['correctMs', 'allMs'].map((key) => median(spent.map((one) => one[key])));
  t.diagnostic(`two hands, ${spent.length} frames: corrected and flattened in ${corrects.toFixed(2)} ms, all of ` +
               `our code ${all.toFixed(2)} ms a frame, the quickest ${quickest().toFixed(2)}`);
  assert.ok(quickest() < MOST_MS);

  const touch = async (row, which) => {
    const [x, y, z] = await page.evaluate(([r, w]) => window.nadePage.panelKey(r, w), [row, which]);
    const tip = rest.right.slice(8 * 10 + 4, 8 * 10 + 7);
    for (const off of [0.06, 0.03, 0]) {
      await put('right', x - tip[0] + 0.4 * off, y - tip[1] + 0.5 * off, z - tip[2] + 0.75 * off);
      await frames(page, 2);
    }
  };
  await touch(0, 1);
  await until(page, () => document.querySelector('#methods [value=paper]').checked);
  await picture('headset-panel');
  await touch(1, 2);
  await until(page, () => document.querySelector('#objects [value=plane]').checked);
  await page.evaluate(() => { window.device.primaryInputMode = 'controller'; });
  await until(page, () => /No hands/.test(window.nadePage.panelSentence()));
  await page.evaluate(() => { window.device.primaryInputMode = 'hand'; });
  await until(page, () => window.nadePage.hand('right'));
  await touch(2, 2);
  await until(page, () => !window.nadePage.isWorn());
  await page.mouse.move(640, 420);
  await until(page, () => window.nadePage.hand('right') && !window.nadePage.hand('left'));
  // IWER leaves its canvas over the page.
  await page.locator('text=Enter AR').dispatchEvent('click');
  await until(page, () => window.nadePage.tableMatrix() && window.nadePage.isWorn());
  await frames(page, 3);
  await picture('headset-ar');
  await done();
});

test('a headset that does not start, and a camera that is refused', async () => {
  const refused = () => {
    navigator.xr.requestSession = () => Promise.reject(new Error('no sensors'));
    navigator.mediaDevices.getUserMedia = () => Promise.reject(new Error('Permission denied'));
  };
  const {page, done} = await browser.open({script: [...headset, refused]});
  await page.press('text=Enter VR', 'Enter');
  await said(page, /^The headset did not start: no sensors$/);
  await until(page, () => window.nadePage.hand('right')?.status === 'corrected');
  await choose(page, 'sources', 'camera');
  await page.click('#consent [value=yes]');
  await said(page, /no camera: Permission denied/);
  assert.ok(await page.isChecked('#sources [value=pointer]'));
  await done();
});

test('keys alone do it all; and once it was loaded, it needs no network', async () => {
  const {page, context, done} = await browser.open();
  const press = (...keys) => keys.reduce((last, key) => last.then(() => page.keyboard.press(key)),
                                         Promise.resolve());
  await press('Tab', 'ArrowRight');
  await frames(page, 8);
  const from = palm(await hand(page));
  for (let i = 0; i < 5; ++i) await press('ArrowRight');
  await until(page, (before) => {
    const {drawn} = window.nadePage.hand('right');
    return Math.hypot(...before.map((x, i) => x - drawn[4 + i])) > 0.03;
  }, from);
  await press('2');
  assert.ok(await page.isChecked('#methods [value=paper]'));
  await press('g', 'b');
  assert.ok(await page.isChecked('[name=ghost]') && await page.isChecked('[name=alive]'));
  await press('Tab', 'Enter');
  assert.ok(await page.isVisible('#about'));
  await press('Escape');
  assert.ok(await page.isHidden('#about'));
  await press('Tab', 'Tab', 'ArrowRight', 'Tab', 'ArrowRight');
  assert.ok(await page.isChecked('#methods [value=nade]'));
  assert.ok(await page.isChecked('#objects [value=ball]'));
  await press('Tab', 'Home');
  assert.equal(await page.inputValue('[name=depth]'), '-0.03');

  await page.evaluate(() => navigator.serviceWorker.ready);
  await context.setOffline(true);
  await page.reload();
  await until(page, () => window.nadePage?.hand('right'));
  await done();
});

test('a small screen held upright, and a finger', async () => {
  const viewport = {width: 390, height: 844};
  const {page, picture, done} = await browser.open({
    viewport, hasTouch: true, isMobile: true});
  await page.touchscreen.tap(190, 405);
  await until(page, () => window.nadePage.hand('right')?.status === 'corrected');
  await frames(page, 12);
  liesOut(await skin(page));
  const {x, y, width, height} = await page.locator('#panel').boundingBox();
  assert.ok(x >= 0 && x + width <= 390 && y + height <= 844);
  const wide = await page.evaluate(() => [...document.querySelectorAll('#panel *, header *, nav *')]
    .filter((part) => part.getBoundingClientRect().right > innerWidth + 0.5).length);
  assert.equal(wide, 0);
  await picture('small');
  await done();
});
