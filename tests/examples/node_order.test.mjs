// client/node/serve: what a back end may order, and what its page hears of it. $CHOREO_SERVER names a choreod.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { withBackEnd } from './back_end.mjs';

/** A dance's events, to its end: [event, data]. */
async function eventsOf(url) {
  const text = await (await fetch(url)).text();
  return [...text.matchAll(/^event: (\w+)\ndata: (.*)$/gm)].map(([, event, data]) => [event, JSON.parse(data)]);
}

test('the end tells how many frames came, at the rate of the page', () =>
  withBackEnd(
    () => ({ seconds: 2, speed: 4, config: { seed: '7', frame_rate: 60 } }),
    async ({ url }) => {
      const events = await eventsOf(url);
      const frames = events.reduce((sum, [event, data]) => sum + (event === 'frames' ? data.places.length / 3 : 0), 0);
      assert.ok(frames > 110, `${frames} frames`);
      assert.deepEqual(events.at(-1), ['over', { frames }]);
    },
  ));
