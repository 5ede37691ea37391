// Pictures for a film of the page, 25 a second: node film.js FOLDER. A mouse strokes the dog.
import {mkdirSync, rmSync} from 'node:fs';
import {join} from 'node:path';

import {openBrowser, until} from './browser.js';

const SECONDS = 3.6;
const FRAME_MS = 40;
/** Until the hand lies on the dog. */
const BEFORE_MS = 2000;
const SIZE = {width: 1280, height: 800};
const PIXELS = 0.75;
/** Shares of the window. */
const MIDDLE = [0.5, 0.43];
const STROKE = [0.085, 0.02];

const [folder] = process.argv.slice(2);
rmSync(folder, {recursive: true, force: true});
mkdirSync(folder, {recursive: true});

const browser = await openBrowser();
try {
  const {page, done} = await browser.open({viewport: SIZE, deviceScaleFactor: PIXELS});
  // There and back once, so that the film's end is its beginning.
  const stroke = (share) => page.mouse.move(
    SIZE.width * (MIDDLE[0] - STROKE[0] * Math.cos(2 * Math.PI * share)),
    SIZE.height * (MIDDLE[1] + STROKE[1] * Math.sin(2 * Math.PI * share)));
  // The page's time goes on as the film's, however long drawing takes; what it measures is nothing.
  await page.evaluate(() => { document.querySelector('#moment').style.display = 'none'; });
  await page.clock.install();
  await page.clock.pauseAt(new Date(Date.now() + 1000));
  const frames = Math.round(1000 * SECONDS / FRAME_MS);
  for (let i = -BEFORE_MS / FRAME_MS; i < frames; ++i) {
    await stroke(i / frames);
    await page.clock.fastForward(FRAME_MS);
    if (i >= 0) await page.screenshot({path: join(folder, `${String(i).padStart(3, '0')}.png`)});
  }
  await until(page, () => window.nadePage.hand('right').status === 'corrected');
  await done();
} finally {
  await browser.close();
}
