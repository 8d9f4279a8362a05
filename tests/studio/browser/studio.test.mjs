// The studio in a browser, as people use it: a song is dropped, a key dragged, a pose bent, a take kept, a file exported and opened again,
// and the server lost on the way.
//   node studio.test.mjs CHOREO_PROGRAM PICTURES_FOLDER
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { check, clicks, inFolder, inStudio, patience, program, takePictures } from './harness.mjs';

const seconds = 12;

/// Measures what each picture takes, milliseconds: what runs for it in the page, less the renderer's calls, and these, by the clock; and all
/// that the page's thread does, by the processor's time, which others on the machine do not lengthen.
async function timeFrames(page) {
  const session = await page.context().newCDPSession(page);
  await session.send('Performance.enable', { timeDomain: 'threadTicks' });
  const spent = async () => (await session.send('Performance.getMetrics')).metrics.find(({ name }) => name === 'TaskDuration').value;
  await page.evaluate(() => {
    const { renderer } = window.choreo.stage.value;
    const [ask, render] = [window.requestAnimationFrame, renderer.render];
    const frames = new Map(); // by their time
    let drawn = 0;
    window.requestAnimationFrame = (callback) => ask.call(window, (time) => {
      const [began, before] = [performance.now(), drawn];
      callback(time);
      const frame = frames.get(time) ?? { own: 0, calls: 0 };
      frame.calls += drawn - before;
      frame.own += performance.now() - began - (drawn - before);
      frames.set(time, frame);
    });
    renderer.render = (...args) => {
      const began = performance.now();
      render.apply(renderer, args);
      drawn += performance.now() - began;
    };
    window.spentOnFrames = () => {
      [window.requestAnimationFrame, renderer.render] = [ask, render];
      return [...frames.values()].filter(({ calls }) => calls > 0);
    };
  });
  const before = await spent();
  return async () => {
    const after = await spent();
    const all = await page.evaluate(() => window.spentOnFrames());
    const share = (which) => {
      const values = all.map((frame) => frame[which]).sort((a, b) => a - b);
      return { median: values[Math.floor(values.length / 2)], p99: values[Math.floor(values.length * 0.99)] };
    };
    return { own: share('own'), calls: share('calls'), thread: (1000 * (after - before)) / all.length, count: all.length };
  };
}

await inStudio(async ({ page, errors, until, settle, message, frames, scale, give, drop, download, host }) => {
  const changed = (before, after) => after.flatMap((pose, i) => (pose === before[i] ? [] : [i]));

  await check('a page with landmarks and names', async () => {
    await page.getByRole('button', { name: 'Choose a song' }).waitFor();
    for (const [role, name] of [['banner', undefined], ['main', 'Stage'], ['complementary', 'Poses'], ['complementary', 'Settings'], ['region', 'Timeline']])
      assert.equal(await page.getByRole(role, name ? { name } : {}).count(), 1, `${role} ${name}`);
  });

  await check('a song that is there before its dance breaks nothing', async () => {
    await page.evaluate(() => {
      const heard = { seconds: 3, tempo: 120, beats: [1], counts: [1], beatsInBar: 4, suggested: [], passages: [], peaks: [0, 1, 0] };
      window.choreo.song.value = { name: 'early.wav', url: '', bytes: new Uint8Array(), analysis: heard };
    });
    await until(() => document.querySelector('.wave div')?.shadowRoot?.querySelector('canvas'));
    await page.evaluate(() => (document.querySelector('.wave').style.width = '2px')); // as a narrow window has it
    await page.waitForTimeout(500);
    await page.evaluate(() => (window.choreo.song.value = null));
    assert.deepEqual(errors, []);
  });

  await check('a dropped song is danced to', async () => {
    await drop('clicks.wav', clicks(seconds).toString('base64'));
    await page.locator('.key').first().waitFor();
    await settle();
    assert.equal(await page.evaluate(() => window.choreo.motion.value.count), 30 * seconds);
    assert.ok((await page.locator('.key').count()) >= 5);
    assert.ok((await page.locator('.suggested').count()) >= 4);
    // One is a pose on a beat, which is set when it is pressed.
    const marks = page.getByRole('button', { name: /^Suggested: / });
    const [said, before] = [await marks.nth(1).getAttribute('aria-label'), await page.locator('.key').count()];
    const [, pose, second] = /^Suggested: (.+) at 0:(.+)$/.exec(said);
    await marks.nth(1).click();
    await settle();
    const key = await page.evaluate(() => window.choreo.project.value.keys.find(({ id }) => id === window.choreo.selectedKey.value));
    assert.equal(key.id.replace(/[_-]/g, ' ').toLowerCase().startsWith(pose.toLowerCase()), true, `${key.id}, not ${pose}`);
    assert.ok(Math.abs(key.frame / 30 - Number(second)) < 0.1, `at ${key.frame / 30} s, not ${second} s`);
    await page.evaluate(() => window.choreo.undo());
    await settle();
    assert.equal(await page.locator('.key').count(), before);
  });

  // True where the page may be left without being asked.
  const isLeft = () => page.evaluate(() => window.dispatchEvent(new Event('beforeunload', { cancelable: true })));

  await check('links lead past the bar and the poses', async () => {
    await page.evaluate(() => document.activeElement.blur());
    for (const id of ['stage', 'timeline']) {
      const link = page.getByRole('link', { name: `Skip to the ${id}` });
      await link.focus();
      assert.ok((await link.boundingBox()).y >= 0);
      await link.press('Enter');
      await until((id) => document.activeElement.id === id, id);
    }
  });

  await check('a dragged key dances its intervals anew, and no other frame changes', async () => {
    assert.ok(await isLeft(), 'nothing was done yet');
    const before = await frames();
    const keys = await page.evaluate(() => window.choreo.project.value.keys.map(({ frame }) => frame));
    const box = await page.locator('.key').nth(2).boundingBox();
    await page.mouse.move(box.x + 20, box.y + 20);
    await page.mouse.down();
    await page.mouse.move(box.x + 30, box.y + 20);
    await page.mouse.move(box.x + 20 + 0.45 * (await scale()), box.y + 20); // near the next beat, on which it stands then
    await page.mouse.up();
    await settle();
    const [moved, beats] = await page.evaluate(() => [window.choreo.project.value.keys[2].frame, window.choreo.beats.value.list.map(({ time }) => Math.round(30 * time))]);
    assert.equal(moved, beats.find((beat) => beat > keys[2] + 5));
    const touched = changed(before, await frames());
    assert.ok(touched.length > 10);
    assert.ok(touched.every((frame) => frame > keys[1] && frame < keys[3]), `${touched[0]} to ${touched.at(-1)}`);
  });

  await check('undo brings every frame back, redo the change', async () => {
    const after = await frames();
    await page.keyboard.press('Control+z');
    const before = await frames();
    assert.ok(changed(before, after).length > 10);
    await page.keyboard.press('Control+Shift+z');
    assert.deepEqual(changed(after, await frames()), []);
  });

  await check('a key that is removed by keyboard leaves the focus with the next', async () => {
    const next = await page.locator('.key').nth(2).getAttribute('data-key');
    await page.locator('.key').nth(1).press('Delete');
    await settle();
    assert.equal(await page.evaluate(() => document.activeElement?.dataset.key), next);
    await page.keyboard.press('Control+z');
    await settle();
  });

  await check('a pose is bent by its hand, and danced', async () => {
    await page.locator('.key').nth(1).click();
    const { x, y } = await until(() => window.choreo.stage.value?.whereIs('left_hand'));
    // Half way to the head, which every arm reaches.
    const head = await page.evaluate(() => window.choreo.stage.value.whereIs('head'));
    const aim = { x: (x + head.x) / 2, y: (y + head.y) / 2 };
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move((x + aim.x) / 2, (y + aim.y) / 2);
    await page.mouse.move(aim.x, aim.y);
    await page.mouse.up();
    await settle();
    const away = await page.evaluate(() => {
      const [, key] = window.choreo.project.value.keys;
      const place = (pose) => window.choreo.place(pose, 'left_wrist');
      const [asked, danced] = [place(key.pose), place(window.choreo.motion.value.pose(key.frame))];
      return Math.hypot(...asked.map((value, i) => value - danced[i]));
    });
    assert.ok(away < 1e-3, `the dance is ${away} m off the key`);
    const to = await page.evaluate(() => window.choreo.stage.value.whereIs('left_hand'));
    assert.ok(Math.hypot(to.x - aim.x, to.y - aim.y) < 25, 'the hand is not where it was pulled');
  });

  await check('a pose of the library is carried onto the timeline', async () => {
    const count = await page.locator('.key').count();
    const from = await page.locator('.library li button').nth(1).boundingBox();
    const lane = await page.locator('.lane').boundingBox();
    await page.mouse.move(from.x + 30, from.y + 30);
    await page.mouse.down();
    await page.mouse.move(from.x + 40, from.y + 40);
    await page.mouse.move(lane.x + 40 + (await scale()) * 7.3, lane.y + 40, { steps: 3 });
    await page.mouse.up();
    await settle();
    assert.equal(await page.locator('.key').count(), count + 1);
  });

  await check('jumps and floor poses are a press away, and are set like others', async () => {
    const kinds = page.getByRole('group', { name: 'Kinds of poses' });
    for (const [kind, name] of [['Jump', 'star jump'], ['Floor', 'kneel']]) {
      await kinds.getByRole('button', { name: kind }).click();
      await page.locator(`#poses-${kind.toLowerCase()}`).waitFor();
      const pose = page.getByRole('complementary', { name: 'Poses' }).getByRole('button', { name });
      assert.ok(await pose.isVisible());
    }
    await page.evaluate(() => (window.choreo.audio.currentTime = 6.5));
    const before = await page.evaluate(() => window.choreo.project.value.keys.length);
    await page.getByRole('complementary', { name: 'Poses' }).getByRole('button', { name: 'kneel' }).click();
    await settle();
    const key = await page.evaluate(() => window.choreo.project.value.keys.find(({ id }) => id.startsWith('kneel')));
    assert.ok(key.pose.root[1] < 0.7, `its hips are at ${key.pose.root[1]} m`);
    await page.evaluate(() => window.choreo.undo());
    await settle();
    assert.equal(await page.evaluate(() => window.choreo.project.value.keys.length), before);
  });

  await check('a take of an interval is tried and kept', async () => {
    const before = await frames();
    await page.locator('.interval').nth(1).click();
    const [from, to] = await page.evaluate(() => window.choreo.selection.value);
    await page.getByRole('button', { name: 'Try 3 more' }).click();
    const keep = page.getByRole('complementary', { name: 'Settings' }).getByRole('button', { name: 'Keep C' });
    await keep.waitFor();
    await page.waitForTimeout(2000); // the camera steps back
    await page.screenshot({ path: inFolder('takes.png'), timeout: patience });
    await keep.click();
    await settle();
    const touched = changed(before, await frames());
    assert.ok(touched.length > 10);
    assert.ok(touched.every((frame) => frame > from && frame < to));
  });

  await check('an interval is frozen, and the rest danced anew', async () => {
    const before = await frames();
    await page.locator('.interval').nth(1).click();
    const [from, to] = await page.evaluate(() => window.choreo.selection.value);
    await page.getByRole('button', { name: 'Freeze it, try the rest' }).click();
    const keep = page.getByRole('complementary', { name: 'Settings' }).getByRole('button', { name: 'Keep D' });
    await keep.waitFor();
    await keep.click();
    await settle();
    const touched = changed(before, await frames());
    assert.ok(touched.every((frame) => frame < from || frame > to), 'the frozen interval is another one');
    assert.ok(touched.some((frame) => frame < from) && touched.some((frame) => frame > to));
    await page.keyboard.press('Control+z');
  });

  await check('a style is danced', async () => {
    const before = await frames();
    await page.getByLabel('How to dance').selectOption('tired');
    await settle();
    assert.ok(changed(before, await frames()).length > 100);
  });

  await check('a project is saved, readable, opened again, and danced by the command line, too', async () => {
    const text = readFileSync(await download(() => page.getByRole('button', { name: 'Save' }).click()), 'utf8');
    const keys = await page.evaluate(() => window.choreo.project.value.keys.length);
    assert.equal(JSON.parse(text).keyframes.length, keys);
    assert.equal(JSON.parse(text).style, 'tired');
    await give(['clicks.json', text]);
    await settle();
    assert.equal(await page.evaluate(() => window.choreo.project.value.keys.length), keys);
    assert.equal(await page.getByLabel('How to dance').inputValue(), 'tired');
    const here = readFileSync(await download(() => page.getByLabel('Export the dance').selectOption('bvh')), 'utf8');
    writeFileSync(inFolder('clicks.wav'), clicks(seconds));
    writeFileSync(inFolder('project.json'), text);
    execFileSync(program, ['dance', '--project', inFolder('project.json'), '--out', inFolder('project.bvh')], { stdio: 'ignore' });
    assert.ok(readFileSync(inFolder('project.bvh'), 'utf8') === here, 'the command line dances it otherwise');
  });

  for (const extension of ['glb', 'bvh', 'npz']) {
    await check(`a dance is exported as ${extension} and opened again`, async () => {
      const before = await page.evaluate(() => window.choreo.motion.value.pose(100).root);
      const path = await download(() => page.getByLabel('Export the dance').selectOption(extension));
      await page.locator('input[type=file]').first().setInputFiles({ name: `dance.${extension}`, mimeType: 'application/octet-stream', buffer: readFileSync(path) });
      await until((name) => window.choreo.message.value?.text.startsWith(name), `dance.${extension}`);
      await settle();
      const after = await page.evaluate(() => window.choreo.motion.value.pose(100).root);
      assert.ok(Math.hypot(...before.map((value, i) => value - after[i])) < 1e-3);
      await page.keyboard.press('Control+z');
    });
  }

  await check('what is odd in a file is said once, where it says what was opened', async () => {
    const path = await download(() => page.getByLabel('Export the dance').selectOption('bvh'));
    const text = readFileSync(path, 'utf8').replace(/Frames: \d+/, 'Frames: 7');
    await give(['odd.bvh', text]);
    await until(() => window.choreo.message.value?.text.startsWith('odd.bvh'));
    await settle();
    assert.match((await message()).text, /^odd\.bvh: [\d.]+ s of dance\. Note: its header says 7 frames; all \d+ that are there are read\.$/);
    await page.keyboard.press('Control+z');
    assert.equal(await message(), null, 'a message about the dance that is left');
    const piped = clicks(6);
    piped.writeUInt32LE(0, 40);
    await drop('piped.wav', piped.toString('base64'));
    await until(() => window.choreo.song.value.name === 'piped.wav' && window.choreo.busy.value === 0);
    assert.match((await message()).text, /^piped\.wav: 6\.0 s of song\. Note: its header says 0 bytes of samples, \d+ are there\.$/);
    await page.keyboard.press('Control+z');
    await until(() => window.choreo.song.value.name === 'clicks.wav' && window.choreo.busy.value === 0);
  });

  await check('another song is danced to, and undo brings back the first', async () => {
    await drop('short.wav', clicks(6).toString('base64'));
    await until(() => window.choreo.song.value.name === 'short.wav' && window.choreo.busy.value === 0);
    const said = await message();
    assert.ok(!said?.isError, said?.text);
    assert.equal(await page.evaluate(() => window.choreo.motion.value.count), 180);
    await page.keyboard.press('Control+z');
    await until(() => window.choreo.song.value.name === 'clicks.wav' && window.choreo.busy.value === 0);
    assert.equal(await page.evaluate(() => window.choreo.motion.value.count), 30 * seconds);
  });

  await check('what cannot be is said in words', async () => {
    const alert = page.getByRole('alert');
    const count = await page.evaluate(() => window.choreo.moments.value.length);
    const key = { id: 'a', time: 1, rotations: Array(24).fill([0, 0, 0]) };
    const refused = [
      ['noise.wav', 'no sound', /noise\.wav/],
      ['empty.wav', '', /empty\.wav/],
      ['letter.txt', 'x', /letter\.txt is none of the files that the studio knows: \.mp3/],
      ['broken.json', '{', /broken\.json: /],
      ['list.json', '[]', /list\.json: has no list "keyframes"/],
      ['newer.json', '{"studio": 2, "keyframes": []}', /newer\.json:studio: is format 2, known is 1/],
      ['words.json', '{"keyframes": [{"time": 1, "pose": "kik"}]}', /words\.json:keyframes\[0\]\.pose: .*kik/],
      ['early.json', JSON.stringify({ keyframes: [{ ...key, time: -1 }] }), /keyframes\[0\]\.time: -1/],
      ['late.json', JSON.stringify({ keyframes: [{ ...key, time: 4000 }] }), /late\.json:keyframes\[0\]\.time: 4000 s is beyond 3600 s/],
      ['far.json', JSON.stringify({ keyframes: [{ ...key, root_position: [0, 1, 1e30] }] }), /far\.json:keyframes\[0\]\.root_position\[2\]: 1e\+30 m is further/],
      ['twice.json', JSON.stringify({ keyframes: [key, { ...key, time: 2 }] }), /"a" is already the id of an earlier key/],
      ['close.json', JSON.stringify({ keyframes: [key, { ...key, id: 'b' }] }), /close\.json:keyframes\[1\]\.time: key "b" stands closer than 2 frames to "a"/],
      ['held.json', JSON.stringify({ keyframes: [{ time: 1, pose: 'star_jump', place: [0, 0], hold: 2 }] }), /held\.json:keyframes\[0\]\.hold: .* m in the air/],
      ['turned.json', JSON.stringify({ keyframes: [{ ...key, rotations: Array(24).fill([0, 99, 0]) }] }), /rotations\[0\]: 99 rad exceeds/],
      ['seed.json', JSON.stringify({ studio: 1, seed: -1, keyframes: [key] }), /seed\.json:seed: -1 is not a whole number/],
      ['endless.json', JSON.stringify({ studio: 1, seconds: 1e300, keyframes: [key] }), /seconds: 1e\+300 is not above 0 and up to 3600/],
    ];
    for (const [name, content, words] of refused) {
      await page.evaluate(() => (window.choreo.message.value = null));
      await give([name, content]);
      await alert.waitFor();
      assert.match(await alert.innerText(), words);
    }
    await page.evaluate(() => (window.choreo.message.value = null));
    await drop('endless.wav', '', 201 << 20);
    await alert.waitFor();
    assert.match(await alert.innerText(), /endless\.wav has 201 MiB; the studio takes 200/);
    assert.equal(await page.evaluate(() => window.choreo.moments.value.length), count);
    await page.evaluate(() => (window.choreo.message.value = null));
  });

  await check('the loss of the server is survived', async () => {
    const works = until(() => window.choreo.busy.value > 0); // looked for from before, as it may be short
    await page.getByRole('button', { name: 'New poses' }).click();
    await works;
    execFileSync('pkill', ['-KILL', '-P', String(host.pid()), 'choreod']);
    await settle();
    assert.equal(await page.evaluate(() => window.choreo.motion.value.count), 30 * seconds);
    const said = await message();
    assert.ok(!said?.isError, said?.text);
  });

  await check('so is the loss of the studio program', async () => {
    await page.getByRole('button', { name: 'New poses' }).click();
    await until(() => window.choreo.busy.value > 0);
    await host.kill();
    await until(() => window.choreo.message.value?.isError && window.choreo.busy.value === 0);
    await host.restart();
    await until((count) => window.choreo.busy.value === 0 && window.choreo.isConnected.value && window.choreo.motion.value.count === count, 30 * seconds);
    assert.deepEqual(await message(), { text: 'The studio program is there again.', isError: false });
  });

  await check('it plays, picture and sound together', async () => {
    await page.evaluate(() => (window.choreo.audio.currentTime = 0));
    const spent = await timeFrames(page);
    await page.getByRole('button', { name: 'Play', exact: true }).click();
    await until(() => window.choreo.audio.currentTime > 6);
    const late = await page.evaluate(() => window.choreo.stage.value.lateness);
    const rate = await page.evaluate(() => window.choreo.stage.value.rate);
    await page.getByRole('button', { name: 'Pause' }).click();
    console.log(`    ${rate.toFixed(0)} pictures a second of a software renderer; the picture shows the sound of ${(1000 * late).toFixed(0)} ms ago at most`);
    const { own, calls, thread, count } = await spent();
    const shown = ({ median, p99 }) => `${median.toFixed(1)} ms (median), ${p99.toFixed(1)} (99 of 100)`;
    console.log(`    of the 16.7 ms of each of ${count} pictures our own code takes ${shown(own)}; three.js and WebGL's calls, which wait for the renderer here, ${shown(calls)}`);
    console.log(`    the page's thread is busy for ${thread.toFixed(1)} ms a picture (mean, of the processor's time)`);
  });

  await check('the floor is seen wherever the dancer goes', async () => {
    const colours = await page.evaluate(() => [-3, 3].map((z) => {
      const { renderer, scene, camera, floor } = window.choreo.stage.value;
      floor.position.z += z;
      renderer.render(scene, camera);
      const gl = renderer.getContext();
      const pixel = new Uint8Array(4);
      gl.readPixels(gl.drawingBufferWidth / 2, gl.drawingBufferHeight * 0.15, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      floor.position.z -= z;
      return [...pixel];
    }));
    // Less blue than the background, which is #fbf9f6.
    for (const [, , blue] of colours) assert.ok(blue < 0xf6 - 8, `${colours}`);
  });

  await check('work that is not saved is asked for before the page is left', async () => {
    assert.ok(!(await isLeft()));
    await download(() => page.getByRole('button', { name: 'Save' }).click());
    assert.ok(await isLeft());
  });

  await page.evaluate(() => {
    window.choreo.message.value = null;
    window.choreo.stage.value.sharpen();
  });
  await page.locator('.key').nth(2).click();
  await takePictures(page);
});
