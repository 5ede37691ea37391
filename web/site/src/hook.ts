// For tests and the curious: what the page shows, as numbers, in `window.nadePage`.
import type {Side} from '../../src/index.js';
import type {Page} from './main.js';

const FAR_M = 2;

export function hookOf(page: Page) {
  return {
    /** A hand of this frame as tracked and as drawn, 26 joints of 8 numbers; null without one. */
    hand: (side: Side) => {
      const {tracked, result} = page.shown[side] ?? {};
      return tracked && result ? {tracked: [...tracked], drawn: [...result.joints],
                                  status: result.status, fault: result.fault} : null;
    },
    /** Metres from the object's surface, below 0 inside. */
    distance: (point: [number, number, number]) =>
      page.thing.closestPoint(point, FAR_M)?.signedDistance ?? null,
    /** How far the deepest vertex of each joint's drawn skin is from the surface, metres. */
    skin: (side: Side) => {
      const nearest: Record<string, number> = {};
      for (const {joint, point} of page.shown[side]?.vertices() ?? []) {
        const away = page.thing.closestPoint(point.toArray(), FAR_M)?.signedDistance ?? FAR_M;
        nearest[joint] = Math.min(nearest[joint] ?? FAR_M, away);
      }
      return nearest;
    },
    /** Of the frames since the last call, milliseconds: correcting and flattening, and all of our code but drawing. */
    spent: () => page.spent.splice(0),
    /** Of the last time that the dog's surface was refitted, milliseconds. */
    refitMs: () => page.thing.living?.refitMs ?? null,
    replay: () => (page.replay ? {time: page.replay.time, seconds: page.replay.seconds,
                                  playing: page.replay.playing} : null),
    camera: () => (page.camera ? {seen: page.camera.seen, spentMs: page.camera.spentMs} : null),
    /** In a headset: where a key of the panel is in the scene, and the sentence below the keys. */
    panelKey: (row: number, which: number) => {
      const {panel} = page.headset;
      return panel.mesh.localToWorld(panel.centerOf(row, which)).toArray();
    },
    panelSentence: () => page.headset.panel.sentence,
    /** From the scene to the headset's own space: a matrix, column by column; null before. */
    tableMatrix: () => page.headset.tableMatrix?.toArray() ?? null,
    isWorn: () => page.headset.isWorn,
  };
}

declare global {
  interface Window { nadePage?: ReturnType<typeof hookOf> }
}
