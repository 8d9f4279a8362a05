// Poses from photos: MediaPipe Pose finds landmarks in the page; the program fits the body to them.
import type { Pose as Detector, Results } from '@mediapipe/pose';
import type { Pose, Triple } from '../project/body';
import { wire } from './link';
import { audio } from './songs';
import { message, selectedKey, sketch, takes, notify, welcome, work } from '../project/state';

const photoTypes: Record<string, string> = { jpg: 'image/jpeg', jpeg: 'image/jpeg', png: 'image/png', webp: 'image/webp' };
export const photoExtensions = Object.keys(photoTypes);
// MediaPipe is made for videos: the first pass may confuse front and back, the second corrects that.
const looks = 2;
const mostPixels = 1280; // of a side; larger pictures are scaled down

let isLooking = false;
let detector: Promise<Detector> | null = null;

/// The program serves its files, which are too large for the page.
function load(): Promise<Detector> {
  detector ??= new Promise<Detector>((resolve, reject) => {
    const script = document.createElement('script');
    script.src = '/photo/pose.js';
    script.onload = () => {
      const { Pose: Made } = window as unknown as { Pose: new (config: object) => Detector };
      const made = new Made({ locateFile: (file: string) => `/photo/${file}` });
      made.setOptions({ modelComplexity: 1, smoothLandmarks: false });
      resolve(made);
    };
    script.onerror = () => reject(new Error('The reader of photos could not be loaded.'));
    document.head.append(script);
  }).catch((error: unknown) => {
    detector = null;
    throw error;
  });
  return detector;
}

async function draw(name: string, url: string): Promise<HTMLCanvasElement> {
  const image = new Image();
  image.src = url;
  try {
    await image.decode();
  } catch {
    throw new Error(`${name} is no picture that this browser knows.`);
  }
  const scale = Math.min(1, mostPixels / Math.max(image.naturalWidth, image.naturalHeight, 1));
  const canvas = document.createElement('canvas');
  canvas.width = Math.max(1, Math.round(image.naturalWidth * scale));
  canvas.height = Math.max(1, Math.round(image.naturalHeight * scale));
  canvas.getContext('2d')!.drawImage(image, 0, 0, canvas.width, canvas.height);
  return canvas;
}

async function look(canvas: HTMLCanvasElement): Promise<Results | null> {
  const seer = await load();
  let seen: Results | null = null;
  seer.onResults((results) => {
    seen = results;
  });
  seer.reset(); // forget the earlier photo
  for (let i = 0; i < looks; ++i) await seer.send({ image: canvas });
  return seen;
}

/// Finds the pose in a photo and puts it on the stage for editing.
export const readPhoto = (name: string, bytes: Uint8Array) => work(async () => {
  if (!welcome.value?.readsPhotos)
    throw new Error(`${name}: photos need @mediapipe/pose, which is not here. \`make studio\` fetches it where there is npm; start the studio anew then.`);
  if (isLooking) throw new Error('One photo at a time.');
  isLooking = true;
  notify(`Looking for somebody in ${name} …`);
  const url = URL.createObjectURL(new Blob([bytes as BlobPart], { type: photoTypes[name.split('.').at(-1)!.toLowerCase()] }));
  try {
    const canvas = await draw(name, url);
    const seen = await look(canvas);
    if (!seen?.poseWorldLandmarks) throw new Error(`${name}: nobody was found in it. One person, seen from head to foot, is found best.`);
    const landmarks = seen.poseWorldLandmarks.map(({ x, y, z, visibility = 1 }) => ({ x, y, z, visibility: Math.min(1, Math.max(0, visibility)) }));
    const answer = await wire.request({ case: 'landmarks', value: { name, data: new TextEncoder().encode(JSON.stringify(landmarks)) } });
    if (answer.case !== 'pose') return;
    const { id, pose } = answer.value;
    const root = pose!.rootPosition!;
    const found: Pose = { root: [root.x, root.y, root.z] as Triple, rotations: pose!.rotations };
    audio.pause();
    [selectedKey.value, takes.value] = [null, []];
    dropSketch();
    sketch.value = {
      id: id.replace(/[^\p{L}\p{N}_-]+/gu, '_').slice(0, 40) || 'photo',
      pose: found,
      photo: { url, width: canvas.width, height: canvas.height, marks: seen.poseLandmarks.map(({ x, y, visibility = 1 }) => ({ x, y, visibility })) },
    };
    message.value = null;
  } catch (error) {
    URL.revokeObjectURL(url);
    throw error;
  } finally {
    isLooking = false;
  }
});

/// Discards the photo and its pose.
export function dropSketch() {
  if (sketch.value) URL.revokeObjectURL(sketch.value.photo.url);
  sketch.value = null;
}
