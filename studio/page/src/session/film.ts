// Films the dance with its song. Pictures are drawn and encoded one after another, so none is dropped.
import * as Mp4 from 'mp4-muxer';
import * as WebM from 'webm-muxer';
import type { Motion } from '../project/motion';
import type { Song } from '../project/state';

export const [width, height, fps] = [1280, 720, 30];
const rate = 48000; // audio sample rate, Hz
const pictureRate = 5e6; // bits a second
const soundRate = 128e3;
const keyEvery = 60; // pictures
const mostWaiting = 4; // pictures in the encoder
const nextLook = 100; // ms after which the encoder is looked at again: not every browser tells of each picture that it has taken

export type Kind = 'webm' | 'mp4';
/// Video codecs, best first.
const codecs: Record<Kind, string[]> = { webm: ['vp09.00.31.08', 'vp8'], mp4: ['avc1.640020', 'avc1.42001f', 'vp09.00.31.08'] };
/// Audio codecs, best first.
const soundCodecs: Record<Kind, string[]> = { webm: ['opus'], mp4: ['mp4a.40.2', 'opus'] };

/// The first configuration that this browser supports.
async function choose<Config>(configs: Config[], isSupported: (config: Config) => Promise<{ supported?: boolean }>): Promise<Config> {
  for (const config of configs) if ((await isSupported(config)).supported) return config;
  throw new Error('This browser does not make such films; `choreo render --video` does.');
}

async function chooseCodecs(kind: Kind) {
  if (!('VideoEncoder' in window)) throw new Error('This browser makes no films; `choreo render --video` does.');
  const pictures = codecs[kind].map((codec): VideoEncoderConfig => ({ codec, width, height, bitrate: pictureRate, framerate: fps }));
  const sounds = soundCodecs[kind].map((codec): AudioEncoderConfig => ({ codec, numberOfChannels: 2, sampleRate: rate, bitrate: soundRate }));
  return {
    picture: await choose(pictures, (config) => VideoEncoder.isConfigSupported(config)),
    sound: await choose(sounds, (config) => AudioEncoder.isConfigSupported(config)),
  };
}

type Chunks = {
  addVideoChunk: (chunk: EncodedVideoChunk, about?: EncodedVideoChunkMetadata) => void;
  addAudioChunk: (chunk: EncodedAudioChunk, about?: EncodedAudioChunkMetadata) => void;
  finalize: () => void;
};

/// A muxer for encoded pictures and sound, and the file's bytes once it is finalised.
function makeFile(kind: Kind, picture: string, sound: string | null): { file: Chunks; bytes: () => Uint8Array } {
  const voice = { numberOfChannels: 2, sampleRate: rate };
  const isVp9 = picture.startsWith('vp09');
  if (kind === 'webm') {
    const target = new WebM.ArrayBufferTarget();
    const video = { codec: isVp9 ? 'V_VP9' : 'V_VP8', width, height, frameRate: fps };
    return { file: new WebM.Muxer({ target, video, ...(sound ? { audio: { ...voice, codec: 'A_OPUS' } } : {}) }), bytes: () => new Uint8Array(target.buffer) };
  }
  const target = new Mp4.ArrayBufferTarget();
  const video = { codec: isVp9 ? 'vp9' : 'avc', width, height, frameRate: fps } as const;
  const audio = sound ? { audio: { ...voice, codec: sound === 'opus' ? 'opus' : 'aac' } as const } : {};
  return { file: new Mp4.Muxer({ target, video, ...audio, fastStart: 'in-memory' }), bytes: () => new Uint8Array(target.buffer) };
}

/// The song, decoded and cut to the dance's length.
async function decode(song: Song, seconds: number): Promise<AudioBuffer> {
  const context = new OfflineAudioContext(2, Math.ceil(seconds * rate), rate);
  const source = context.createBufferSource();
  source.buffer = await context.decodeAudioData(song.bytes.slice().buffer as ArrayBuffer);
  source.connect(context.destination);
  source.start();
  return context.startRendering();
}

async function encodeSound(sound: AudioBuffer, encoder: AudioEncoder) {
  const piece = rate / 10;
  const channels = [sound.getChannelData(0), sound.getChannelData(1)];
  for (let at = 0; at < sound.length; at += piece) {
    const count = Math.min(piece, sound.length - at);
    const data = new Float32Array(2 * count);
    channels.forEach((channel, i) => data.set(channel.subarray(at, at + count), i * count));
    const timestamp = Math.round((at * 1e6) / rate);
    const part = new AudioData({ format: 'f32-planar', sampleRate: rate, numberOfFrames: count, numberOfChannels: 2, timestamp, data });
    encoder.encode(part);
    part.close();
  }
  await encoder.flush();
  encoder.close();
}

/// Draws the pictures of a film, one every `pace` seconds, until `leave`.
export type Painter = {
  picture: (motion: Motion, time: number, pace: number, width: number, height: number) => HTMLCanvasElement;
  leave: () => void;
};

type Plan = {
  kind: Kind;
  motion: Motion;
  song: Song | null;
  /// Draws a moment of the dance; returns the canvas.
  draw: (time: number) => HTMLCanvasElement;
  /// Receives the progress, 0 to 1.
  progressed: (share: number) => void;
  signal: AbortSignal;
};

const { port1, port2 } = new MessageChannel();
/// Lets the page react; a timer would wait 4 ms each time.
const breathe = () => new Promise<unknown>((resolve) => {
  port1.onmessage = resolve;
  port2.postMessage(null);
});

/// Films a whole dance; returns the file's bytes.
export async function film({ kind, motion, song, draw, progressed, signal }: Plan): Promise<Uint8Array> {
  const chosen = await chooseCodecs(kind);
  const seconds = motion.count / motion.fps;
  const { file, bytes } = makeFile(kind, chosen.picture.codec, song && chosen.sound.codec);
  let failure: unknown = null;
  let wake = () => {};
  const error = (what: unknown) => {
    failure = what;
    wake();
  };
  const pictures = new VideoEncoder({ output: (chunk, about) => file.addVideoChunk(chunk, about), error });
  pictures.configure(chosen.picture);
  pictures.ondequeue = () => wake();
  if (song) {
    const encoder = new AudioEncoder({ output: (chunk, about) => file.addAudioChunk(chunk, about), error });
    encoder.configure(chosen.sound);
    await encodeSound(await decode(song, seconds), encoder);
  }
  const count = Math.round(seconds * fps);
  for (let i = 0; i < count && !failure; ++i) {
    if (signal.aborted) throw new Error('The film was cancelled.');
    const picture = new VideoFrame(draw(i / fps), { timestamp: Math.round((i * 1e6) / fps), duration: Math.round(1e6 / fps) });
    pictures.encode(picture, { keyFrame: i % keyEvery === 0 });
    picture.close();
    progressed(i / count);
    await breathe();
    while (pictures.encodeQueueSize > mostWaiting && !failure && !signal.aborted) await new Promise<void>((resolve) => {
      wake = resolve;
      setTimeout(resolve, nextLook);
    });
  }
  if (failure) throw failure;
  await pictures.flush();
  pictures.close();
  file.finalize();
  return bytes();
}
