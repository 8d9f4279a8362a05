// client/node, the package: keys get their answers once, also where their server is killed. $CHOREO_SERVER names a choreod, $CHOREOD the program
// of it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { pose } from '../../client/node/src/index.js';
import { danceAndKill, told, undisturbed } from './killed_dance.mjs';

const keyFor = (skeleton) => (id, when, more) => ({ keyframe: { id, ...when, pose: pose(skeleton), ...more } });
const rejections = (answers) => answers.flatMap(({ event }) => (event?.keyframe_rejected ? [[event.keyframe_rejected.id, Number(event.frame), event.keyframe_rejected.code]] : []));
/** For danceAndKill: once there is a continuation and so many keys are rejected. */
const after = (count) => (all) => all.some(({ continuation }) => continuation) && rejections(all).length === count;

async function* rejected(skeleton, { goOn } = {}) {
  const key = keyFor(skeleton);
  yield { config: { seed: '5', frames: 150, generate_until: 0, reject_invalid_keys: true } };
  yield key('stays', { frame: 40 });
  yield key('moves', { frame: 30 });
  yield key('moves', { frame: 80 });
  yield { generate_until: { frame: 70 } };
  yield key('here', { frame: 37 }, { hands: 'FLAT' }); // the package refuses it
  yield { keyframe: { id: 'here', frame: 53 } };
  yield { remove_keyframe: { id: 'here' } };
  yield key('near', { frame: 3 });
  yield key('near', { interval_after_previous: 1 }); // does not count
  yield key('beyond', { interval_after_previous: 107_999 }); // nor does this
  yield key('stays', { interval_after_previous: 37 });
  yield key('here', { frame: 41 }, { hit: 9 });
  await goOn;
  yield key('near', { frame: 3 });
  yield key('beyond', { frame: 108_001 });
  yield key('stays', { interval_after_previous: 37 });
  yield key('late', { interval_after_previous: 10 });
  yield key('here', { frame: 41 }, { hit: 9 });
  for (const id of ['late', 'here', 'stays', 'nobody']) yield { remove_keyframe: { id } };
  yield { generate_until: { frame: 150 } };
}

test('every key is answered once, before and after its server is killed', async () => {
  const whole = await undisturbed(rejected);
  const before = [
    ['here', 37, 'REJECTION_CODE_INVALID'],
    ['here', 53, 'REJECTION_CODE_INVALID'],
    ['here', 53, 'REJECTION_CODE_REJECTED_BEFORE'],
    ['near', 3, 'REJECTION_CODE_TOO_LATE'],
    ['near', -1, 'REJECTION_CODE_INVALID'],
    ['beyond', -1, 'REJECTION_CODE_INVALID'],
    ['stays', 40, 'REJECTION_CODE_FROZEN'],
    ['here', 41, 'REJECTION_CODE_INVALID'],
  ];
  assert.deepEqual(rejections(whole), [
    ...before,
    ['near', 3, 'REJECTION_CODE_TOO_LATE'],
    ['beyond', -1, 'REJECTION_CODE_INVALID'],
    ['stays', 40, 'REJECTION_CODE_FROZEN'],
    ['late', 50, 'REJECTION_CODE_TOO_LATE'],
    ['here', 41, 'REJECTION_CODE_INVALID'],
    ['late', 50, 'REJECTION_CODE_REJECTED_BEFORE'],
    ['here', 41, 'REJECTION_CODE_REJECTED_BEFORE'],
    ['stays', 40, 'REJECTION_CODE_FROZEN'],
    ['nobody', -1, 'REJECTION_CODE_INVALID'],
  ]);
  const { answers, resumes } = await danceAndKill(rejected, after(before.length));
  assert.equal(resumes.length, 1);
  assert.deepEqual(told(answers), told(whole));
});

test('keys before the continuation from which a caller goes on are answered once, too', async () => {
  const whole = await undisturbed(rejected);
  const { continuation } = whole.find((answer) => answer.continuation);
  async function* goingOn(skeleton, { goOn } = {}) {
    const key = keyFor(skeleton);
    yield { config: { continuation, frames: 240, generate_until: 0 } };
    yield key('danced', { frame: 10 });
    yield key('moves', { frame: 90 });
    yield key('stops', { frame: 120 });
    yield key('moves', { frame: 200 });
    yield { generate_until: { frame: 150 } };
    await goOn;
    yield key('moves', { frame: 90 });
    yield { generate_until: { frame: 240 } };
  }
  const undivided = await undisturbed(goingOn);
  const danced = ['danced', 10, 'REJECTION_CODE_ALREADY_DANCED'];
  assert.deepEqual(rejections(undivided), [danced, ['moves', 90, 'REJECTION_CODE_TOO_LATE']]);
  const { answers, resumes } = await danceAndKill(goingOn, after(1));
  assert.equal(resumes.length, 1);
  assert.deepEqual(told(answers), told(undivided));
});
