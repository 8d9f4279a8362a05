// Records the microphone, piece by piece.

/// A running recording. `stop` releases the microphone.
export type Microphone = { rate: number; stop: () => void };

const refusals: Record<string, string> = {
  NotAllowedError: 'The browser does not let this page use the microphone.',
  NotFoundError: 'There is no microphone.',
  NotReadableError: 'The microphone is in use elsewhere.',
};

/// Records until stopped. Calls `lost` if the microphone is unplugged.
export async function listen(onPiece: (piece: Float32Array) => void, onLost: () => void): Promise<Microphone> {
  if (!navigator.mediaDevices) throw new Error('Browsers allow the microphone only for pages of this machine: open the studio as http://127.0.0.1.');
  // Raw sound: processing for speech would remove the music.
  const wanted = { echoCancellation: false, noiseSuppression: false, autoGainControl: false };
  const stream = await navigator.mediaDevices.getUserMedia({ audio: wanted }).catch((error: DOMException) => {
    throw new Error(refusals[error.name] ?? `The microphone cannot be opened: ${error.message}`);
  });
  const context = new AudioContext();
  const stop = () => {
    for (const track of stream.getTracks()) track.stop();
    if (context.state !== 'closed') void context.close();
  };
  try {
    await context.audioWorklet.addModule('/microphone.js');
    const node = new AudioWorkletNode(context, 'microphone', { numberOfOutputs: 0 });
    node.port.onmessage = ({ data }) => onPiece(data as Float32Array);
    context.createMediaStreamSource(stream).connect(node);
    stream.getTracks()[0].onended = onLost;
    await context.resume();
  } catch (error) {
    stop();
    throw error;
  }
  return { rate: context.sampleRate, stop };
}
