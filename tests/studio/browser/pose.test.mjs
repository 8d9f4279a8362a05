// Poses in the studio by parts, by numbers and by keyboard; keys that ask for a part of the body; key files with names in them.
//   node pose.test.mjs CHOREO_PROGRAM PICTURES_FOLDER
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { check, clicks, inFolder, inStudio, program, takePictures } from './harness.mjs';

const seconds = 8;

await inStudio(async ({ page, until, settle, rest, message, frames, give, download }) => {
  await give(['clicks.wav', clicks(seconds)]);
  await page.locator('.key').first().waitFor();
  await settle();
  const panel = page.getByRole('region', { name: 'Key' });
  const parts = panel.getByRole('group', { name: 'Parts that are worked on' });
  const choose = (nth) => page.locator('.key').nth(nth).click();
  const key = (nth) => page.evaluate((nth) => window.choreo.project.value.keys[nth], nth);
  const danced = (frame) => page.evaluate((frame) => window.choreo.motion.value.pose(frame), frame);
  const names = await page.evaluate(() => window.choreo.welcome.value.model.skeleton.jointNames);
  const of = (pose, joint) => pose.rotations.slice(3 * names.indexOf(joint), 3 * names.indexOf(joint) + 3);
  /// What `choreo pose` says of a key's joints, degrees.
  const degrees = ({ pose }) => {
    const file = inFolder('one.json');
    const rotations = names.map((name) => of(pose, name));
    writeFileSync(file, JSON.stringify({ keyframes: [{ id: 'one', time: 1, root_position: pose.root, rotations }] }));
    const said = execFileSync(program, ['pose', '--from', file], { encoding: 'utf8' });
    return (joint) => new RegExp(`${joint}[=: ]+([-0-9., ]+)`).exec(said)[1].split(/[, ]+/).filter(Boolean).map(Number);
  };

  await check('bent knees have no dots: thigh and shin, which both are seen there, are equally round', async () => {
    await until(() => window.choreo.stage.value?.doll);
    const bent = await page.evaluate(() => {
      const { doll } = window.choreo.stage.value;
      const { height, names } = doll.skeleton;
      const knee = window.choreo.place({ root: [0, height, 0], rotations: Array(3 * names.length).fill(0) }, 'left_knee');
      const out = [];
      doll.scene.traverse(({ material, geometry }) => {
        if (material?.name !== 'left') return;
        const { position, normal } = geometry.attributes;
        for (let i = 0; i < position.count; ++i) {
          const away = [0, 1, 2].map((axis) => position.getComponent(i, axis) - knee[axis]);
          const radius = Math.hypot(...away);
          if (Math.abs(radius - 0.056) > 1e-4) continue;
          out.push(away.reduce((sum, value, axis) => sum + (value / radius) * normal.getComponent(i, axis), 0));
        }
      });
      return out;
    });
    assert.ok(bent.length > 200, `${bent.length} corners`);
    assert.ok(Math.min(...bent) > 0.999, `${Math.min(...bent)}`);
  });

  await check('joints are turned by numbers and arrow keys, and mean what `choreo pose` means', async () => {
    await choose(1);
    await panel.getByText('Joints in degrees').click();
    await panel.getByLabel('Joint', { exact: true }).selectOption('left_elbow');
    const bend = panel.getByLabel('left elbow, degrees that it bends');
    await bend.fill('70');
    await bend.press('Tab');
    await bend.press('ArrowUp');
    await bend.press('Shift+ArrowUp');
    await rest();
    assert.equal(await bend.inputValue(), '81');
    await panel.getByLabel('Joint', { exact: true }).selectOption('right_shoulder');
    for (const [axis, value] of [['x', '-20'], ['y', '35'], ['z', '10']]) {
      const field = panel.getByLabel(`right shoulder, degrees about ${axis}`);
      await field.fill(value);
      await field.press('Tab');
    }
    await rest();
    const said = degrees(await key(1));
    assert.ok(Math.abs(said('left_elbow')[0] - 81) < 0.2, said('left_elbow'));
    [-20, 35, 10].forEach((value, i) => assert.ok(Math.abs(said('right_shoulder')[i] - value) < 0.2, said('right_shoulder')));
    const { frame, pose } = await key(1);
    const there = await danced(frame);
    for (const joint of ['left_elbow', 'right_shoulder'])
      of(there, joint).forEach((value, i) => assert.ok(Math.abs(value - of(pose, joint)[i]) < 2e-3));
  });

  await check('what no joint does is told beside it, and changes nothing', async () => {
    await panel.getByLabel('Joint', { exact: true }).selectOption('left_elbow');
    const bend = panel.getByLabel('left elbow, degrees that it bends');
    const before = await key(1);
    for (const [text, words] of [['200', /^The left elbow bends 0 to 165 degrees, not 200\.$/], ['-1', /not -1/], ['', /a number is missing/], ['1e99', /not 1e99/]]) {
      await bend.fill(text);
      await bend.press('Enter');
      assert.match(await panel.getByRole('alert').innerText(), words);
      assert.equal(await bend.getAttribute('aria-invalid'), 'true');
    }
    await bend.press('Tab');
    assert.equal(await bend.inputValue(), '81');
    await rest();
    assert.deepEqual(await key(1), before);
  });

  await check('of a pose of the library the arms alone are taken', async () => {
    for (const part of ['trunk', 'left leg', 'right leg']) await parts.getByRole('button', { name: part }).click();
    const before = await key(1);
    await panel.getByLabel('Take these parts from a pose').selectOption({ label: 'victory v' });
    await settle();
    const after = await key(1);
    const library = await page.evaluate(() => window.choreo.welcome.value.poses.find(({ id }) => id === 'victory_v').pose.rotations);
    for (const name of names) {
      const isArm = /shoulder|elbow|wrist|hand|collar/.test(name);
      const wanted = of(isArm ? { rotations: library } : before.pose, name);
      of(after.pose, name).forEach((value, i) => assert.ok(Math.abs(value - wanted[i]) < 1e-6, name));
    }
    assert.deepEqual(after.pose.root, before.pose.root);
  });

  await check('handles of other parts are not there', async () => {
    await panel.getByText('Handles by keyboard').click();
    const handles = panel.getByRole('application', { name: 'Handles' }).getByRole('button');
    assert.deepEqual(await handles.allInnerTexts(), ['left hand', 'right hand']);
    const count = await page.evaluate(() => window.choreo.moments.value.length);
    const before = await key(1);
    await handles.first().evaluate((handle) => {
      for (let i = 0; i < 5; ++i) handle.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowDown', bubbles: true, cancelable: true }));
    });
    await rest();
    assert.equal(await page.evaluate(() => window.choreo.moments.value.length), count + 1, 'each press is a change of its own');
    const after = await key(1);
    assert.notDeepEqual(of(after.pose, 'left_shoulder'), of(before.pose, 'left_shoulder'));
    assert.deepEqual(of(after.pose, 'spine1'), of(before.pose, 'spine1'));
  });

  await check('a partial key asks for the arms alone: they are hit, the rest is free', async () => {
    const before = await frames();
    await panel.getByLabel('Ask for these parts alone').check();
    await settle();
    await panel.getByText('The key asks for left arm, right arm.').waitFor();
    assert.match(await page.locator('.key').nth(1).getAttribute('aria-label'), /only left arm, right arm/);
    const { frame, pose, joints, hasPlace } = await key(1);
    assert.deepEqual(joints.map((joint) => names[joint]).filter((name) => !/collar|shoulder|elbow|wrist|hand/.test(name)), []);
    assert.equal(hasPlace, false);
    assert.ok(await panel.getByRole('button', { name: 'To the floor' }).isDisabled());
    const there = await danced(frame);
    for (const joint of ['left_shoulder', 'right_elbow'])
      of(there, joint).forEach((value, i) => assert.ok(Math.abs(value - of(pose, joint)[i]) < 2e-3, joint));
    const free = names.filter((name) => of(there, name).some((value, i) => Math.abs(value - of(pose, name)[i]) > 0.02));
    assert.ok(free.length >= 3, `as asked, too: ${free}`);
    assert.notDeepEqual(await frames(), before);
  });

  await takePictures(page, 'pose-');

  await check('it is saved, opened again, and danced by the command line frame for frame', async () => {
    const text = readFileSync(await download(() => page.getByRole('button', { name: 'Save' }).click()), 'utf8');
    const saved = JSON.parse(text).keyframes[1];
    assert.ok(saved.joints.includes('left_elbow') && !saved.joints.includes('spine1') && !('root_position' in saved));
    const { joints } = await key(1);
    await give(['clicks.json', text]);
    await settle();
    assert.deepEqual((await key(1)).joints, joints);
    const here = readFileSync(await download(() => page.getByLabel('Export the dance').selectOption('bvh')), 'utf8');
    writeFileSync(inFolder('clicks.wav'), clicks(seconds));
    writeFileSync(inFolder('partial.json'), text);
    execFileSync(program, ['dance', '--project', inFolder('partial.json'), '--out', inFolder('partial.bvh')], { stdio: 'ignore' });
    assert.ok(readFileSync(inFolder('partial.bvh'), 'utf8') === here, 'the command line dances it otherwise');
  });

  await check('one part at least is asked for, and all of them are a whole key again', async () => {
    await choose(1);
    await parts.getByRole('button', { name: 'left arm' }).click();
    await settle();
    await parts.getByRole('button', { name: 'right arm' }).click();
    assert.equal((await message()).text, 'Pick at least one part.');
    await panel.getByLabel('Ask for these parts alone').uncheck();
    await settle();
    const { joints, hasPlace } = await key(1);
    assert.deepEqual([joints, hasPlace], [null, true]);
  });

  await check('the dance ends in a key\'s pose, held to its last frame, and the command line ends it likewise', async () => {
    await choose(1);
    const { id } = await key(1);
    await panel.getByRole('button', { name: 'End in it' }).click();
    await settle();
    const [total, last] = await page.evaluate(() => [window.choreo.total.value, window.choreo.project.value.keys.at(-1)]);
    assert.ok(last.id.startsWith(id.replace(/-\d+$/, '')), last.id);
    assert.deepEqual([last.frame + last.hold, last.hit], [total - 1, 1]);
    assert.ok(last.hold >= 30 && last.hold < 60, `held for ${last.hold} frames`);
    const [first, end] = [await danced(last.frame), await danced(total - 1)];
    assert.ok(first.rotations.every((value, i) => Math.abs(value - end.rotations[i]) < 0.02));
    const text = readFileSync(await download(() => page.getByRole('button', { name: 'Save' }).click()), 'utf8');
    writeFileSync(inFolder('ending.json'), text);
    execFileSync(program, ['dance', '--project', inFolder('ending.json'), '--out', inFolder('ending.npz'), '--report', inFolder('ending-report.json')], { stdio: 'ignore' });
    const reported = JSON.parse(readFileSync(inFolder('ending-report.json'), 'utf8')).keyframes;
    assert.equal(reported.at(-1).frame, total - 1);
    await page.screenshot({ path: inFolder('pose-ending.png') });
  });

  await check('a key file with names of poses, degrees, limbs and a held pose is opened', async () => {
    await give(['words.json', JSON.stringify({ keyframes: [
      { id: 'begin', time: 0, pose: 'stand', place: [0, 0] },
      { id: 'wave', time: 2, joints: { right_elbow: 60 } },
      { id: 'arms', time: 4, pose: 'victory_v', joints: ['arms'] },
      { id: 'strong', time: 6, pose: 'muscles', hold: 0.2 },
    ] })]);
    await settle();
    const keys = await page.evaluate(() => window.choreo.project.value.keys);
    assert.deepEqual(keys.map(({ id }) => id), ['begin', 'wave', 'arms', 'strong']);
    assert.equal(keys[3].hold, 6);
    assert.deepEqual(keys[1].joints.map((joint) => names[joint]), ['right_elbow']);
    await choose(1);
    await panel.getByText('The key asks for right elbow.').waitFor();
    assert.deepEqual(await panel.getByLabel('Joint', { exact: true }).locator('option').allTextContents(), ['right elbow']);
    assert.equal(await panel.getByLabel('right elbow, degrees that it bends').inputValue(), '60');
    await parts.getByRole('button', { name: 'trunk' }).click();
    await settle();
    await panel.getByText('The key asks for trunk, right elbow.').waitFor();
  });
});
