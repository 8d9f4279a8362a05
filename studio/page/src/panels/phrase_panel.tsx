// What can be done with a phrase beside the stage.
import { show } from '../timeline/scale';
import * as studio from '../session/studio';

export function PhrasePanel() {
  const { value } = studio.project;
  const phrase = studio.selection.value;
  const keys = studio.chosenKeys().length;
  const { fps } = studio.dancer ?? { fps: 30 };
  return (
    <section aria-label="Phrase">
      <h2>Phrase {phrase && <small>{(phrase[0] / fps).toFixed(1)} to {(phrase[1] / fps).toFixed(1)} s, {keys === 1 ? 'one key' : `${keys} keys`}</small>}</h2>
      {!phrase && <p class="small">Drag along the timeline with Shift, or choose the eight around the playhead; then pull its ends.</p>}
      <div class="row">
        {!phrase && <>
          <button disabled={!value} onClick={studio.chooseEight}>Choose an eight</button>
          <button disabled={!value} title="The whole dance" onClick={studio.chooseAll}>Choose all</button>
        </>}
        {phrase && <>
          <button disabled={keys === 0} title="Left becomes right" onClick={studio.mirrorPhrase}>Mirror</button>
          <button disabled={keys === 0} title="Again, right after it; keys there are removed" onClick={() => studio.repeatPhrase()}>Repeat</button>
          <button disabled={keys < 2} title="Again, without its last key, for which you press a pose" onClick={() => studio.repeatPhrase(true)}>Repeat with another ending</button>
          <div class="choices" role="group" aria-label="Time">
            <button disabled={keys === 0} title="Its keys twice as far apart; keys in the way are removed" onClick={() => studio.stretchPhrase(2)}>Half time</button>
            <button disabled={keys === 0} title="Its keys half as far apart" onClick={() => studio.stretchPhrase(0.5)}>Double time</button>
          </div>
          <button disabled={keys === 0} title="Copy its keys (Ctrl+C)" onClick={studio.copyKeys}>Copy</button>
        </>}
        {studio.canPaste.value && <button disabled={!value} title="The copied keys, from the playhead on (Ctrl+V)" onClick={studio.pasteKeys}>Paste at playhead</button>}
        {phrase && <>
          <button disabled={keys === 0} title="Remove its keys (Delete)" onClick={studio.removePhrase}>Remove keys</button>
          <button title="Fill the timeline with it" onClick={() => show(...phrase)}>Zoom to it</button>
          <button title="Choose nothing (Escape)" onClick={() => (studio.selection.value = null)}>Leave</button>
        </>}
      </div>
    </section>
  );
}
