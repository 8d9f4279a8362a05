// Everything that the page's parts use, and what happens when the program connects.
import { Control } from '../generated/choreo/v1/choreography_pb';
import { finish } from './history';
import { compose } from './keys';
import { whenConnected } from './link';
import { audio, returnTo, useSong, showSongNotes } from './songs';
import { stopLive } from './live';
import { begin, showError, isUnsaved, live, moment, song, notify, welcome, work } from '../project/state';

export * from './beats';
export { addPartner, cast, changePartner, faceEachOther, formation, removePartner, shirtNumber, workOnDanceOf } from './company';
export * from './copies';
export * from './files';
export { follow, following } from './following';
export { clearPath, drawPath, drawing, lengthOf, rush, stretch } from './floor_path';
export { change, motionAt, redo, total, undo } from './history';
export * from './keys';
export { addMarker, moveMarker, removeMarker, renameMarker } from './markers';
export { addCorner, areCornersShown, draftCorners, corners, heldCorner, setCorners } from './path_corners';
export { addPose, forgetPose, ownPoses } from './own_poses';
export { dropSketch } from './photos';
export * from './phrases';
export { inWords, movable, partsOf, worked } from './masks';
export { dancer, skeleton } from './link';
export { isAsHeard, level, now, startLive, stopLive } from './live';
export { audio } from './songs';
export * from '../project/state';
export { keepTake, tryTakes, tryTheRest } from './takes';

let version = '';

whenConnected((received, isFirst) => {
  if (isFirst) {
    version = received.version;
    if (!received.song || !received.heard) return;
    useSong(received.song.name, received.song.data, received.heard);
    return void work(async () => {
      await begin(compose);
      showSongNotes();
    });
  }
  if (received.version !== version) return showError(new Error(`The studio program is now ${received.version}: save the project and reload this page.`));
  notify('The studio program is there again.');
  void work(async () => {
    const known = moment.value?.song ?? song.value;
    if (known) await returnTo(known);
    if (moment.value) finish(moment.value);
  });
});

// Makes the browser ask before it leaves the page.
window.addEventListener('beforeunload', (event) => {
  if (isUnsaved.value) event.preventDefault();
});

export const togglePlay = () => {
  if (live.value) return void stopLive();
  if (!audio.paused) return audio.pause();
  if (audio.ended) audio.currentTime = 0;
  // An immediate pause rejects the promise of play; this is no error.
  void audio.play().catch((error: DOMException) => error.name !== 'AbortError' && showError(error));
};

/// Whether the model hears music at all.
export const canHear = () => !!welcome.value?.model && !welcome.value.model.takesNoMusic;

/// Whether the model supports floor paths.
export const canBeLed = () => welcome.value?.model?.controls.includes(Control.ROOT_PATH) ?? false;

/// Whether the model supports velocity factors.
export const takesVelocities = () => welcome.value?.model?.controls.includes(Control.VELOCITY_FACTORS) ?? false;
