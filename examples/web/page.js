// A dance that is being made, on a character, to music.
import { bonesOf, Character, Player } from 'choreo-client/character';
import { loadCharacter, makeDoll, makeStage } from '/stage.js';

const before = 0.7; // seconds of poses that must be there before the music goes on
const ahead = 2; // seconds from a click to its pose, and at least
const beyond = 1.2; // so many after what has come, which is frozen: music that waits falls behind
const $ = (selector) => document.querySelector(selector);
/** The last words first. */
const say = (text) => ($('#log').textContent = `${text}\n${$('#log').textContent}`.split('\n').slice(0, 4).join('\n'));

let header; // of the dance
let chosen; // the character: {scene, humanoid}; without one there is a doll
let shown; // {character, objects, dance, player}
let recent = []; // messages that are not past yet
let over = false;
let wanted = false; // music
const song = new Audio();

const showOn = makeStage($('#stage'), () => {
  if (!shown) return;
  const { state, pose, ahead: seconds } = shown.player.at(song.currentTime);
  shown.character.show(pose, shown.objects);
  // Music waits for the dancer.
  if (state === 'starved' && !song.paused && !over) song.pause();
  if (wanted && song.paused && !song.ended && (seconds > before || over)) song.play().catch((error) => ((wanted = false), say(error.message)));
});

/** Puts the dance on the character, as far as it has come and is not past. */
function embody() {
  if (!header) return;
  const { scene, humanoid } = chosen ?? { scene: makeDoll(header.skeleton) };
  const { bones, objects } = bonesOf(scene, humanoid);
  const character = new Character(bones, header.skeleton);
  const [dance, player] = [character.dance(header), new Player(header)];
  for (const frames of recent) player.add(dance.add(frames));
  if (over) finish({ dance, player });
  shown = { character, objects, dance, player };
  showOn(scene, objects[character.bones.pelvis]);
}

function finish({ dance, player }) {
  player.add(dance.end());
  player.end();
}

/** Throws for a character that cannot dance. */
async function requireBody({ scene, humanoid }) {
  const answer = await fetch('/skeleton');
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
  [recent, over, wanted, shown] = [[], false, true, undefined];
  song.currentTime = 0;
  const events = new EventSource(`/dance?seed=${Math.floor(1e9 * Math.random())}`);
  const on = (name, act) => events.addEventListener(name, ({ data }) => act(JSON.parse(data)));
  const end = (text) => {
    events.close();
    over = true;
    if (shown) finish(shown);
    say(text);
    $('#dance').disabled = false;
    for (const button of document.querySelectorAll('[data-turns]')) button.disabled = true;
  };
  on('dance', (told) => {
    header = told;
    try {
      embody();
    } catch (error) {
      chosen = undefined;
      embody();
      say(`This character cannot dance: ${error.message}`);
    }
    for (const button of document.querySelectorAll('[data-turns]')) button.disabled = false;
  });
  on('frames', ({ first, places, turns }) => {
    const frames = { first_frame: first, count: places.length / 3, root_positions: places, rotations: turns };
    const past = (song.currentTime - 1) * header.frame_rate;
    recent = [...recent.filter(({ first_frame }) => first_frame > past), frames];
    shown.player.add(shown.dance.add(frames));
  });
  on('key', ({ id, time, refused }) => say(refused ? `${id}: ${refused}` : `${id}: reached at ${time.toFixed(1)} s`));
  on('warning', ({ message }) => say(message));
  on('moved', ({ address }) => say(`The dance goes on at ${address}.`));
  on('over', () => end('The dance is made.'));
  on('failed', ({ message }) => end(message));
  // The browser asks for the rest by itself, until it hears that there is none.
  events.onerror = () => (events.readyState === EventSource.CLOSED ? end('The dance is gone.') : say('The connection is lost.'));
}

let clicks = 0;
async function ask(button) {
  const now = song.currentTime;
  const time = now + Math.max(ahead, shown.player.ahead(now) + beyond);
  const key = { id: `${button.textContent} ${++clicks}`, time, rotations: JSON.parse(button.dataset.turns) };
  const answer = await fetch(`/dance/${header.id}/keys`, { method: 'POST', body: JSON.stringify(key) });
  say(answer.ok ? `${key.id}: asked for at ${key.time.toFixed(1)} s` : await answer.text());
}

const guarded = (act) => (event) => act(event).catch((error) => say(error.message)); // the server may be gone
$('#dance').onclick = guarded(begin);
for (const button of document.querySelectorAll('[data-turns]')) button.onclick = guarded(() => ask(button));
$('#file').onchange = ({ target }) => {
  if (target.files[0]) choose(target.files[0]);
  target.value = ''; // the same file may be chosen again
};
addEventListener('dragover', (event) => event.preventDefault());
addEventListener('drop', (event) => {
  event.preventDefault();
  if (event.dataTransfer.files[0]) choose(event.dataTransfer.files[0]);
});
