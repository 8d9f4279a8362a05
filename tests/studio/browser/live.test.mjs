// The studio's live mode: Chromium's microphone is a WAV file, the dance streams, poses are asked for, and what was heard becomes the song.
//   node live.test.mjs CHOREO_PROGRAM PICTURES_FOLDER
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { check, clicks, inFolder, inStudio, program, takePictures } from './harness.mjs';

const file = inFolder('microphone.wav');
writeFileSync(file, clicks(60));

await inStudio(async ({ page, until, settle, message, give, host }) => {
  const following = () => page.evaluate(() => [window.choreo.project.value.dynamics, window.choreo.project.value.variation]);

  await check('the microphone is danced to while it sounds', async () => {
    const music = page.getByRole('region', { name: 'Music' });
    await music.getByLabel('energy').fill('1');
    await music.getByLabel('variation').fill('0');
    await page.getByRole('button', { name: 'Use the microphone' }).click();
    await until(() => window.choreo.live.value?.motion.count > 90);
    assert.deepEqual(await following(), [1, 0], 'as was set before');
    assert.ok(await music.getByLabel('energy').isDisabled(), 'no message changes it later');
    const { now, there } = await page.evaluate(() => ({ now: window.choreo.now(), there: window.choreo.motion.value.count / 30 }));
    console.log(`    at ${now.toFixed(2)} s there are ${there.toFixed(2)} s of dance`);
    const moved = await page.evaluate(() => {
      const { motion } = window.choreo.live.value;
      return Math.max(...motion.pose(20).rotations.map((value, i) => Math.abs(value - motion.pose(motion.count - 1).rotations[i])));
    });
    assert.ok(moved > 0.1, 'she stands still');
    await until(() => window.choreo.level.value > 0.1);
  });

  await check('its beats are counted, halved, and told to be as they were heard', async () => {
    const beats = page.getByRole('region', { name: 'Beats' });
    const period = () => {
      const last = window.choreo.live.value.beats.slice(-3).map(({ time }) => time);
      return last.length > 2 ? last[2] - last[0] : 0;
    };
    await until(() => window.choreo.live.value.beats.some(({ isDown }) => isDown));
    await page.locator('.beat.down').first().waitFor();
    await beats.getByRole('button', { name: 'Halve' }).click();
    await until(`(${period})() > 1.9`);
    await beats.getByRole('button', { name: 'This is 1' }).click();
    assert.notEqual(await page.evaluate(() => window.choreo.live.value.hint.one), null);
    await beats.getByRole('button', { name: 'As heard' }).click();
    await until(`(${period})() < 1.1`);
    // A busy machine's clicks reach the page seconds apart, which no taps on beats are: the page presses by itself.
    await beats.getByRole('button', { name: 'Tap' }).evaluate(async (button) => {
      for (let i = 0; i < 5; ++i) {
        button.click();
        await new Promise((resolve) => setTimeout(resolve, 500));
      }
    });
    await until(() => window.choreo.live.value.hint.tempo > 50);
    assert.match((await message()).text, /beats a minute, of 5 taps/);
    await beats.getByRole('button', { name: 'As heard' }).click();
    await page.evaluate(() => (window.choreo.message.value = null));
  });

  await check('a pose that is pressed comes soon, and is hit', async () => {
    await page.locator('.library li button').nth(3).click();
    const { frame, id } = await page.evaluate(() => window.choreo.project.value.keys[0]);
    await takePictures(page, 'live-');
      await until((frame) => window.choreo.motion.value.count > frame, frame);
    const off = await page.evaluate(([frame, id]) => {
      const asked = window.choreo.project.value.keys.find((key) => key.id === id).pose.rotations;
      const danced = window.choreo.motion.value.pose(frame).rotations;
      // Of the root the way it faces is asked for, too. Rotation vectors a whole turn apart are one rotation: compare quaternions.
      const quaternion = ([x, y, z]) => {
        const angle = Math.hypot(x, y, z);
        const scale = angle > 0 ? Math.sin(angle / 2) / angle : 0.5;
        return [Math.cos(angle / 2), x * scale, y * scale, z * scale];
      };
      const joint = (rotations, at) => quaternion([...rotations.slice(3 * at, 3 * at + 3)]);
      const apart = (at) => {
        const of = joint(danced, at);
        return 2 * Math.acos(Math.min(1, Math.abs(joint(asked, at).reduce((sum, value, i) => sum + value * of[i], 0))));
      };
      return Math.max(...Array.from({ length: asked.length / 3 }, (_, at) => apart(at)));
    }, [frame, id]);
    assert.ok(off < 0.01, `${off} rad off`);
  });

  await check('one that is ahead is moved and taken back', async () => {
    const id = await page.evaluate(() => { // so far ahead that it is there for as long as this takes
      window.choreo.addKey(window.choreo.welcome.value.poses[5], Math.round((window.choreo.now() + 20) * 30));
      return window.choreo.project.value.keys.at(-1).id;
    });
    const chip = page.locator(`.key[data-key="${id}"]`);
    await chip.press('Shift+ArrowRight');
    await chip.press('Delete');
    assert.equal(await page.locator(`.key[data-key="${id}"]`).count(), 0);
    assert.equal(await message(), null);
  });

  await check('what was heard becomes the song, and the dance stays', async () => {
    await page.getByRole('complementary', { name: 'Settings' }).getByRole('button', { name: 'Stop' }).click();
    await until(() => !window.choreo.live.value && window.choreo.song.value);
    await settle();
    const { name, heard, count, keys } = await page.evaluate(() => ({
      name: window.choreo.song.value.name,
      heard: window.choreo.song.value.analysis.seconds,
      count: window.choreo.motion.value.count,
      keys: window.choreo.project.value.keys.length,
    }));
    assert.equal(name, 'microphone.wav');
    assert.ok(Math.abs(heard - count / 30) < 0.2, `${heard} s of sound, ${count / 30} s of dance`);
    assert.equal(keys, 1);
    assert.match((await message()).text, /^Export the dance to keep it/);
    assert.deepEqual(await following(), [1, 0]);
  });

  await check('it goes on as any dance: another pose is set in it', async () => {
    await page.evaluate(() => (window.choreo.audio.currentTime = 2));
    await page.locator('.library li button').nth(8).click();
    await settle();
    assert.equal(await page.locator('.key').count(), 2);
  });

  await check('where the program is lost, what was danced stays', async () => {
    await page.getByRole('button', { name: 'Dance to the microphone' }).click();
    await until(() => window.choreo.live.value?.motion.count > 45);
    await give(['song.wav', clicks(2)]);
    await until(() => window.choreo.message.value?.text === 'Stop the live dance first.');
    await host.kill();
    await until(() => window.choreo.message.value?.text.includes('gone'));
    await host.restart();
    await until(() => !window.choreo.live.value && window.choreo.busy.value === 0);
    assert.equal((await message()).text, 'The dance ended early; its frames so far stay.');
    assert.ok((await page.evaluate(() => window.choreo.motion.value.count)) > 45);
  });
}, '--use-fake-ui-for-media-stream', '--use-fake-device-for-media-stream', `--use-file-for-fake-audio-capture=${file}`);

await inStudio(async ({ page, until, message }) => {
  await check('a microphone that is not to be had is told in words', async () => {
    await page.getByRole('button', { name: 'Use the microphone' }).click();
    await until(() => window.choreo.message.value?.isError);
    assert.match((await message()).text, /microphone/);
    assert.equal(await page.evaluate(() => window.choreo.live.value), null);
  });
});
