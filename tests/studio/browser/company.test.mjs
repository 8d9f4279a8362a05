// Several dancers in the studio: beside each other on the stage, kept apart, saved, opened and exported together.
//   node company.test.mjs CHOREO_PROGRAM PICTURES_FOLDER
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { check, clicks, inEachLook, patience } from './harness.mjs';

const seconds = 8;

await inEachLook(async ({ page, until, settle, frames, give, download, hand, takeIt, isFirst }) => {
  await give(['clicks.wav', clicks(seconds)]);
  await page.locator('.key').first().waitFor();
  await settle();
  const panel = page.getByRole('region', { name: 'Dancers' });
  const formed = async () => {
    await settle();
    await until(() => window.choreo.formation.value?.of === window.choreo.moment.value);
    return page.evaluate(() => {
      const { reply, danceOf } = window.choreo.formation.value;
      return { widened: reply.widened, least: reply.least, danceOf };
    });
  };
  const type = async (name, value) => {
    await panel.getByLabel(name).fill(String(value));
    await page.keyboard.press('Tab');
  };
  /// Where the hips of all who are on the stage are, and which way they face; the lead first.
  const seen = () => page.evaluate(() => {
    const { doll, company } = window.choreo.stage.value;
    return [doll, ...company.dolls].filter(({ scene }) => scene.visible).map(({ bones }) => {
      const { x, y, z } = bones[0].getWorldPosition(bones[0].position.clone());
      return [x, y, z];
    });
  });
  /// Waits until a dancer is drawn there.
  const stands = async (nth, place, what, within = 0.01) => {
    let all = [];
    for (const end = Date.now() + patience; Date.now() < end;) {
      all = await seen();
      if (all[nth]?.every((value, axis) => Math.abs(value - place[axis]) < within)) return;
      await page.waitForTimeout(250);
    }
    assert.fail(`${what}: ${JSON.stringify(all)}, not ${place}`);
  };
  const seek = (frame) => page.evaluate((frame) => (window.choreo.audio.currentTime = frame / 30), frame);
  const rootAt = (frame) => page.evaluate((frame) => window.choreo.motion.value.pose(frame).root, frame);
  const press = async (name, nth = 0) => hand.tap(panel.getByRole('button', { name }).nth(nth));

  await check('beside the styles stands how well they show', async () => {
    assert.match(await page.getByRole('region', { name: 'Style' }).innerText(), /They do not show: in \d+ % of seconds a classifier recognises the requested style, by chance in 6 %/);
  });

  await check('a second dancer comes beside the first; no frame of the dance changes', async () => {
    const before = await frames();
    await press('Add a dancer');
    const { widened, least, danceOf } = await formed();
    assert.deepEqual(danceOf, [0, 0]);
    assert.ok(widened >= 1 && least > 0.199, `${widened}, ${least}`);
    assert.deepEqual(await frames(), before);
    await seek(60);
    const [x, y, z] = await rootAt(60);
    await stands(0, [x, y, z], 'the lead');
    await stands(1, [x + 1.4 * widened, y, z - 0.4 * widened], 'the other');
  });

  await check('she is mirrored, counts later, and turned', async () => {
    await hand.tap(panel.getByText('Mirrored').nth(1));
    await type('dancer2, counts later', 4);
    await formed();
    const turned = panel.getByLabel('dancer2, degrees that her dance is turned');
    await turned.fill('90');
    await page.evaluate(() => void (window.choreo.formation.value = { ...window.choreo.formation.value })); // as where one comes meanwhile
    assert.equal(await turned.inputValue(), '90', 'what is typed is lost');
    await page.keyboard.press('Tab');
    const { widened } = await formed();
    await seek(120);
    const [x, y, z] = await rootAt(60); // 4 counts are two seconds
    await stands(1, [1.4 * widened + z, y, -0.4 * widened + x], 'mirrored, later and turned', 0.03);
  });

  await check('they face each other, and do not when that is undone', async () => {
    const facings = () => page.evaluate(() => window.choreo.project.value.dancers.map(({ facing }) => facing));
    await press('Face to face');
    await formed();
    assert.deepEqual(await facings(), [106, -74]);
    await page.evaluate(() => window.choreo.undo());
    await formed();
    assert.deepEqual(await facings(), [0, 90]);
  });

  if (isFirst) {
    await check('who stands too near is moved away, and it is told', async () => {
      await type('dancer2, degrees that her dance is turned', 0);
      await type('dancer2, x in metres', 0.2);
      await type('dancer2, z in metres', 0);
      const { widened, least } = await formed();
      assert.ok(widened > 1.5, `${widened}`);
      assert.ok(Math.abs(least - 0.2) < 0.005, `${least}`);
      assert.match(await panel.getByRole('status').innerText(), /All places are .* times as far/);
      await type('dancer2, x in metres', 1.4);
      await formed();
    });
  }

  await check('a third one dances otherwise, and the others as before', async () => {
    const before = await frames();
    await press('Add a dancer');
    await press('Dances differently', 2);
    const { danceOf } = await formed();
    assert.deepEqual(danceOf, [0, 0, 1]);
    assert.deepEqual(await frames(), before);
    const isOther = await page.evaluate(() => {
      const [one, other] = window.choreo.formation.value.dances.map((dance) => JSON.stringify(dance.pose(45)));
      return one !== other;
    });
    assert.ok(isOther);
    await until(() => window.choreo.stage.value.company.dolls.filter(({ scene }) => scene.visible).length === 2);
  });

  await check('all three are on the stage, from the first moment to the last', async () => {
    for (const frame of isFirst ? [0, 60, 120, 180] : [0, 120]) {
      await seek(frame);
      let away = ['not there'];
      for (let i = 0; i < 120 && away.length > 0; ++i) { // the camera goes there
        await page.waitForTimeout(500);
        away = await page.evaluate(() => {
          const { doll, company, camera } = window.choreo.stage.value;
          return [doll, ...company.dolls].filter(({ scene }) => scene.visible).flatMap(({ bones }, nth) => bones
            .map((bone) => bone.getWorldPosition(bone.position.clone()).project(camera)).filter(({ x, y }) => Math.abs(x) > 1 || Math.abs(y) > 1).map(() => nth));
        });
      }
      assert.deepEqual(away, [], `off the stage at frame ${frame}`);
    }
  });

  await takeIt('company-');

  if (!isFirst) return;

  await check('one has keys of her own, in a file of its own or not, and they can be worked on', async () => {
    const text = readFileSync(await download(() => page.getByRole('button', { name: 'Save' }).click()), 'utf8');
    const all = JSON.parse(text);
    all.dancers = [{ id: 'ada', place: [0, 0] }, { id: 'ben', place: [1.4, 0], keyframes: 'ben.json' }];
    await give(['own.json', JSON.stringify(all)]);
    await until(() => window.choreo.message.value?.isError);
    assert.match(await page.evaluate(() => window.choreo.message.value.text), /ben.json: has keys of ben: open it together/);
    const kick = { keyframes: [{ id: 'own', time: 2, pose: 'kick', place: [0, 0], hands: 'fist' }] };
    await give(['own.json', JSON.stringify(all)], ['ben.json', JSON.stringify(kick)]);
    assert.deepEqual((await formed()).danceOf, [0, 1]);
    const of = () => page.evaluate(() => {
      const { keys, dancers } = window.choreo.project.value;
      return [keys.map(({ id }) => id), dancers.map((partner) => partner.keys?.map(({ id }) => id) ?? null)];
    });
    const common = all.keyframes.map(({ id }) => id);
    assert.deepEqual(await of(), [common, [null, ['own']]]);
    await panel.getByRole('button', { name: 'Work on her keys' }).click();
    assert.deepEqual((await formed()).danceOf, [1, 0]);
    assert.deepEqual(await of(), [['own'], [common, null]]);
    await page.locator('.key').first().click();
    assert.equal(await page.getByLabel('What hands do').locator('option:checked').innerText(), 'fist');
    const before = await frames();
    await page.getByLabel('What hands do').selectOption('point');
    await formed();
    assert.deepEqual(await frames(), before);
    const kept = readFileSync(await download(() => page.getByRole('button', { name: 'Save' }).click()), 'utf8');
    assert.equal(JSON.parse(kept).keyframes[0].hands, 'point');
    await give(['kept.json', kept]);
    await formed();
    assert.deepEqual(await of(), [['own'], [common, null]]);
    await give(['before.json', text]);
    await formed();
    await page.evaluate(() => (window.choreo.message.value = null));
  });

  let saved = '';
  await check('they are saved as a file of dancers has them, opened as they were, and undone', async () => {
    saved = readFileSync(await download(() => page.getByRole('button', { name: 'Save' }).click()), 'utf8');
    const { dancers, apart } = JSON.parse(saved);
    assert.equal(apart, 0.2);
    assert.deepEqual(dancers.map(({ id, mirrored, after }) => [id, mirrored, after]),
      [['dancer1', undefined, undefined], ['dancer2', true, '4 counts'], ['dancer3', undefined, undefined]]);
    const before = await page.evaluate(() => window.choreo.project.value.dancers);
    await give(['p.json', saved]);
    await formed();
    assert.deepEqual(await page.evaluate(() => window.choreo.project.value.dancers), before);
    await page.evaluate(() => { window.choreo.undo(); window.choreo.undo(); window.choreo.undo(); });
    await settle();
    assert.equal(await page.evaluate(() => window.choreo.project.value.dancers.length), 2);
    await page.evaluate(() => { window.choreo.redo(); window.choreo.redo(); });
    await formed();
    await give(['bad.json', saved.replace('"4 counts"', '"soon"')]);
    await until(() => window.choreo.message.value?.isError);
    assert.match(await page.evaluate(() => window.choreo.message.value.text), /bad.json:dancers\[1\].after: "soon"/);
  });

  await check('they are exported together: one .glb with all, or a file for each', async () => {
    const choose = (value) => page.getByLabel('Export the dance').selectOption(value);
    const glb = readFileSync(await download(() => choose('glb')));
    const json = JSON.parse(glb.subarray(20, 20 + glb.readUInt32LE(12)).toString());
    assert.equal(json.skins.length, 3);
    const files = [];
    page.on('download', (file) => files.push(file.suggestedFilename()));
    await choose('bvh');
    for (let i = 0; i < 100 && files.length < 3; ++i) await page.waitForTimeout(200);
    assert.deepEqual(files.sort(), ['clicks.dancer1.bvh', 'clicks.dancer2.bvh', 'clicks.dancer3.bvh']);
  });
});
