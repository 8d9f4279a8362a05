// Opening files, dropped or chosen, and saving.
import { beats } from './beats';
import { countsOf } from '../project/counts';
import { film, fps, height, width } from './film';
import type { Kind, Painter } from './film';
import { writeCompany } from './company';
import { danceFrom, made, push } from './history';
import { compose } from './keys';
import { dancer, skeleton, wire } from './link';
import { Motion } from '../project/motion';
import { emptyProject } from '../project/project';
import { projectMessage, readProject } from '../project/project_file';
import { dropSketch, photoExtensions, readPhoto } from './photos';
import { audio, analyseSong, playSilence, songExtensions, showSongNotes } from './songs';
import { begin, filming, savedProject, live, message, moment, opened, project, song, takes, notify, welcome, work } from '../project/state';
import { timeLeft } from '../project/time_left';

/// A file to send.
type SentFile = { name: string; data: Uint8Array };

const motionExtensions = ['npz', 'npy', 'pkl', 'bvh', 'glb', 'gltf', 'vrma'];
/// File types for the file chooser.
export const accepted = [...songExtensions, 'json', ...motionExtensions, ...photoExtensions].map((extension) => `.${extension}`).join();
const mostBytes = 200 * 2 ** 20; // the largest message to the program, with a margin

const extensionOf = ({ name }: File) => name.split('.').at(-1)!.toLowerCase();

/// Opens songs, projects, motion files and photos; songs first, so that a project opened with a song uses it.
export const openFiles = (files: File[]) => work(async () => {
  const find = (extensions: string[]) => files.filter((file) => extensions.includes(extensionOf(file)));
  const [songs, others, photos] = [find(songExtensions), find(['json', ...motionExtensions]), find(photoExtensions)];
  const strange = files.find((file) => ![...songs, ...others, ...photos].includes(file));
  if (strange) throw new Error(`${strange.name} is none of the files that the studio knows: ${accepted.replaceAll(',', ' ')}`);
  if (live.value && photos.length < files.length) throw new Error('Stop the live dance first.');
  // A project's dancers may have their own key files, which are opened with it.
  const main = others.length > 1 ? await findProject(others) : undefined;
  if (songs.length > 1 || (others.length > 1 && !main) || photos.length > 1)
    throw new Error('One song at a time, one photo, and one project or motion.');
  for (const file of songs) {
    notify(`Listening to ${file.name} …`);
    await analyseSong(file.name, await bytesOf(file));
    message.value = null;
  }
  await begin(async () => {
    if (others.length) await openOther(main ?? others[0], main ? others.filter((file) => file !== main) : []);
    if (others.length === 0 && songs.length === 1) await compose();
  });
  if (songs.length === 1 && !message.value?.isError) showSongNotes(message.value?.text);
  for (const file of photos) await readPhoto(file.name, await bytesOf(file));
});

async function bytesOf(file: File) {
  if (file.size > mostBytes)
    throw new Error(`${file.name} has ${Math.round(file.size / 2 ** 20)} MiB; the studio takes ${mostBytes / 2 ** 20}.`);
  return new Uint8Array(await file.arrayBuffer());
}

/// The only file among several that has dancers, if any.
async function findProject(files: File[]) {
  const found: File[] = [];
  for (const file of files)
    if (extensionOf(file) === 'json' && new TextDecoder().decode(await bytesOf(file)).includes('"dancers"')) found.push(file);
  return found.length === 1 ? found[0] : undefined;
}

async function openOther(file: File, keyFiles: File[]) {
  const bytes = await bytesOf(file);
  const beside: SentFile[] = [];
  for (const other of keyFiles) beside.push({ name: other.name, data: await bytesOf(other) });
  if (extensionOf(file) === 'json') await openProject(file.name, bytes, beside);
  else await openMotion(file.name, bytes);
}

async function openProject(name: string, bytes: Uint8Array, keyFiles: SentFile[]) {
  const notes: string[] = [];
  const answer = await wire.request({ case: 'read', value: { file: { name, data: bytes }, keyFiles, ...countsOf(beats.value) } });
  if (answer.case !== 'project') return;
  const read = readProject(answer.value, dancer.fps, skeleton.height);
  const { styles } = welcome.value!.model!;
  if (read.style && !styles.includes(read.style)) {
    notes.push(`The model has no style "${read.style}", only ${styles.join(', ') || 'none'}.`);
    read.style = '';
  }
  if (song.value) read.seconds = song.value.analysis.seconds;
  if (!read.seconds) read.seconds = ((read.keys.at(-1)?.frame ?? 60) + 30) / dancer.fps;
  const inside = read.keys.filter(({ frame }) => frame < dancer.frames(read));
  const outside = read.keys.length - inside.length;
  if (outside > 0) notes.push(`${outside} of its keys are after the end of the song, and are left out.`);
  const isOther = !!read.song && read.song !== song.value?.name;
  if (isOther && song.value) read.beats = null;
  if (isOther) notes.push(`It was made to ${read.song}: drop that song, too.`);
  if (!song.value) playSilence(read.seconds);
  danceFrom({ ...read, keys: inside }, -1);
  if (notes.length) notify(`${name}: ${notes.join(' ')}`);
}

async function openMotion(name: string, bytes: Uint8Array) {
  const answer = await wire.request({ case: 'open', value: { name, data: bytes } });
  if (answer.case !== 'clip') return;
  const motion = Motion.fromClip(answer.value, skeleton.joints, dancer.fps);
  const from = project.value ?? emptyProject(song.value?.name ?? '', 0);
  const seconds = song.value?.analysis.seconds ?? motion.count / dancer.fps;
  const beats = moment.value?.song === song.value ? from.beats : null;
  push({ ...from, song: song.value?.name ?? from.song, beats, seconds, keys: [] }, motion, async () => motion);
  if (!song.value) playSilence(seconds);
  notify(opened(name, `${(motion.count / dancer.fps).toFixed(1)} s of dance`, answer.value.notes));
}

function download(name: string, data: BlobPart, type = 'application/octet-stream') {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([data], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

const stem = () => (project.value?.song || 'dance').replace(/\.[^.]*$/, '');

export const saveProject = () => work(async () => {
  const { value } = project;
  const answer = await wire.request({ case: 'write', value: projectMessage(value, dancer.fps) });
  if (answer.case !== 'file') return;
  download(`${stem()}.json`, answer.value.data as BlobPart, 'application/json');
  savedProject.value = value;
});

let filmed: AbortController | null = null;
export const leaveFilm = () => filmed?.abort();

/// Makes a film of the dance from the camera's view.
export const exportFilm = (kind: Kind, painter: Painter) => work(async () => {
  if (filmed) return;
  filmed = new AbortController(); // before all that is waited for: one film at a time
  try {
    const { signal } = filmed;
    const { song: played } = moment.value;
    const motion = await made(moment.value);
    audio.pause();
    dropSketch();
    [takes.value, filming.value] = [[], { share: 0, left: '' }];
    let began: number | null = null; // ms; encoding the sound comes first and does not predict the time for pictures
    const bytes = await film({
      kind,
      motion,
      song: played,
      draw: (time) => painter.picture(motion, time, 1 / fps, width, height),
      progressed: (share) => {
        began ??= performance.now();
        filming.value = { share, left: timeLeft(share, (performance.now() - began) / 1000) };
      },
      signal,
    });
    download(`${stem()}.${kind}`, bytes as BlobPart, `video/${kind}`);
  } finally {
    [filmed, filming.value] = [null, null];
    painter.leave();
  }
});

export const exportAs = (extension: string) => work(async () => {
  const there = moment.value;
  const clip = (await made(there)).toClip();
  if (there.project.dancers.length) {
    for (const file of await writeCompany(`${stem()}.${extension}`, there)) download(file.name, file.data as BlobPart);
    return;
  }
  const answer = await wire.request({ case: 'export', value: { name: `${stem()}.${extension}`, clip } });
  if (answer.case === 'file') download(answer.value.name, answer.value.data as BlobPart);
});
