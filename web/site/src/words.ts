// What the page says, and the parts of the panel that come and go.
import type {Camera} from './camera.js';
import type {ShownHand} from './hands.js';
import {offered} from './headset.js';
import type {Immersion} from './headset.js';
import type {Replay} from './replay.js';

const FIGURES_EACH_MS = 250;
const NAMES: Record<Immersion, string> = {'immersive-vr': 'Enter VR', 'immersive-ar': 'Enter AR'};

const find = <Kind extends HTMLElement>(selector: string) =>
  document.querySelector<Kind>(selector)!;
const notice = find('#notice');
let silence: ReturnType<typeof setTimeout> | undefined;

export function say(sentence: string, seconds = Infinity): void {
  clearTimeout(silence);
  notice.textContent = sentence;
  notice.hidden = false;
  if (Number.isFinite(seconds)) silence = setTimeout(unsay, 1000 * seconds);
}

export function unsay(): void { notice.hidden = true; }

/** Shows what belongs to a source of hands. */
export function showSource(source: string): void { document.body.dataset.source = source; }

export function showDialogs(): void {
  find('#about-open').addEventListener('click', () => find<HTMLDialogElement>('#about').showModal());
}

/** Resolves to whether the person agrees. */
export async function askForCamera(): Promise<boolean> {
  const dialog = find<HTMLDialogElement>('#consent');
  dialog.returnValue = '';
  dialog.showModal();
  await new Promise((resolve) => { dialog.addEventListener('close', resolve, {once: true}); });
  return dialog.returnValue === 'yes';
}

/** Buttons for what there is a headset for; a sentence where there is none. */
export async function showHeadsets(enter: (mode: Immersion) => Promise<void>): Promise<void> {
  const modes = await offered();
  find('#no-headset').hidden = modes.length > 0;
  for (const mode of modes) {
    const button = Object.assign(document.createElement('button'),
                                 {type: 'button', textContent: NAMES[mode]});
    button.addEventListener('click', () => {
      enter(mode).catch((error: Error) => say(`The headset did not start: ${error.message}`, 8));
    });
    find('#headsets').append(button);
  }
}

export const replaySpeed = () => 2 ** Number(find<HTMLInputElement>('#speed').value);

export function showReplay(replay: () => Replay | null): void {
  const time = find<HTMLInputElement>('#time');
  find('#play').addEventListener('click', () => replay()?.toggle());
  find('#speed').addEventListener('input', () => {
    const now = replay();
    if (now) now.speed = replaySpeed();
  });
  time.addEventListener('input', () => {
    const now = replay();
    if (!now) return;
    now.playing = false;
    now.time = Number(time.value) * now.seconds;
  });
}

interface Figures {
  hands: ShownHand[];
  correctMs: number;
  /** Null where nothing is refitted. */
  refitMs: number | null;
  camera: Camera | null;
  replay: Replay | null;
}

const spent: number[] = [];
let shownAt = 0;

/** The line below the panel, four times a second. */
export function showFigures(now: number, figures: Figures): void {
  spent.push(figures.correctMs);
  const {replay, camera} = figures;
  if (replay) {
    find('#play').textContent = replay.playing ? 'Pause' : 'Play';
    find<HTMLInputElement>('#time').value = String(replay.time / replay.seconds);
  }
  if (now - shownAt < FIGURES_EACH_MS) return;
  shownAt = now;
  const mean = spent.reduce((sum, x) => sum + x, 0) / spent.length;
  spent.length = 0;
  const results = figures.hands.flatMap(({result}) => result ?? []);
  const contacts = results.flatMap((result) => result.contacts);
  const deepest = contacts.reduce((most, {depth}) => Math.max(most, depth), 0);
  const words = camera ? [camera.words()] : [];
  if (contacts.length > 0) {
    words.push(`${contacts.length} bones touch, ${(1000 * deepest).toFixed(0)} mm deep`);
  } else if (results.length > 0) {
    words.push(results[0].status);
  }
  words.push(`${mean.toFixed(2)} ms`);
  if (figures.refitMs !== null) words.push(`refit ${figures.refitMs.toFixed(1)} ms`);
  if (camera) words.push(`camera ${camera.spentMs.toFixed(0)} ms`);
  find('#moment').textContent = words.join(' · ');
}
