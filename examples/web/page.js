// A dance that is being made, on a character, to music.
import { bonesOf, Character } from 'choreo-client/character';
import { connectDance } from 'choreo-client/page';
import { loadCharacter, makeDoll, makeStage } from '/stage.js';

const $ = (selector) => document.querySelector(selector);
const poses = document.querySelectorAll('[data-turns]');
/** The last words first. */
const say = (text) => ($('#log').textContent = `${text}\n${$('#log').textContent}`.split('\n').slice(0, 4).join('\n'));

let dance;
let header; // of the dance
let chosen; // the character: {scene, humanoid}; without one there is a doll
let shown; // {character, objects}
const song = new Audio();

const showOn = makeStage($('#stage'), () => {
  if (dance && shown) shown.character.show(dance.follow(song).pose, shown.objects);
});

/** Puts the dance on the character. */
function embody() {
  const { scene, humanoid } = chosen ?? { scene: makeDoll(header.skeleton) };
  const { bones, objects } = bonesOf(scene, humanoid);
  const character = new Character(bones, header.skeleton);
  dance.wear(character);
  shown = { character, objects };
  showOn(scene, objects[character.bones.pelvis]);
}

/** Throws for a character that cannot dance. */
async function requireBody({ scene, humanoid }) {
  const answer = await fetch('/dance/skeleton');
  if (answer.ok) new Character(bonesOf(scene, humanoid).bones, await answer.json()); // else nobody knows before the dance
}

/** A character is put in place in the pose in which it rests. */
async function choose(file) {
  const kept = chosen;
  try {
    const next = await loadCharacter(file);
    if (!shown) await requireBody(next);
    chosen = next;
    if (shown) embody();
    else showOn(chosen.scene);
    say(shown ? `${file.name} dances.` : `${file.name} will dance.`);
  } catch (error) {
    chosen = kept;
    say(`${file.name}: ${error.message}`);
  }
}

async function begin() {
  $('#dance').disabled = true;
  song.src ||= URL.createObjectURL(await (await fetch('/song.wav')).blob());
  song.currentTime = 0;
  shown = undefined;
  dance = connectDance(`/dance?seed=${Math.floor(1e9 * Math.random())}`, {
    onKey: ({ id, time, refused }) => say(refused ? `${id}: ${refused}` : `${id}: reached at ${time.toFixed(1)} s`),
    onWarning: ({ message }) => say(message),
    onMoved: () => say('The dance goes on at another server.'),
    onLost: () => say('The connection is lost.'),
    onEnd: (error) => {
      say(error ? error.message : 'The dance is made.');
      $('#dance').disabled = false;
      for (const button of poses) button.disabled = true;
    },
  });
  header = await dance.begun.catch(() => undefined); // onEnd has told
  if (!header) return;
  try {
    embody();
  } catch (error) {
    chosen = undefined;
    embody();
    say(`This character cannot dance: ${error.message}`);
  }
  for (const button of poses) button.disabled = false;
}

let clicks = 0;
async function ask(button) {
  const key = await dance.setKey({ id: `${button.textContent} ${++clicks}`, rotations: JSON.parse(button.dataset.turns) });
  say(`${key.id}: asked for at ${key.time.toFixed(1)} s`);
}

const guarded = (act) => (event) => act(event).catch((error) => say(error.message)); // the server may be gone
$('#dance').onclick = guarded(begin);
for (const button of poses) button.onclick = guarded(() => ask(button));
$('#file').onchange = ({ target }) => {
  if (target.files[0]) choose(target.files[0]);
  target.value = ''; // the same file may be chosen again
};
addEventListener('dragover', (event) => event.preventDefault());
addEventListener('drop', (event) => {
  event.preventDefault();
  if (event.dataTransfer.files[0]) choose(event.dataTransfer.files[0]);
});
