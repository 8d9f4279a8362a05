// The dancers, and how each differs from the others.
import { limits } from '../project/limits';
import { NumberField } from './number_field';
import { shirtOf } from '../scene/palette';
import type { Partner } from '../project/project';
import * as studio from '../session/studio';

const longest = 120; // counts or seconds

function PartnerFields({ partner, nth }: { partner: Partner; nth: number }) {
  const { id, x, z, facing, mirrored, after, inCounts, seed, keys } = partner;
  const set = (what: Partial<Partner>) => studio.changePartner(nth, what);
  const isTaken = (spot: { x: number; z: number }) => studio.project.value.dancers.some((other) => other !== partner && other.x === spot.x && other.z === spot.z);
  const put = (spot: { x: number; z: number }) => (isTaken(spot) ? studio.notify('Another dancer stands there.') : set(spot));
  const isPlain = !mirrored && after === 0 && seed === null && keys === null;
  return (
    <fieldset class="partner">
      <legend style={{ '--shirt': `var(--${shirtOf(studio.shirtNumber(nth))})` }} class="take">{id}</legend>
      <div class="row">
        <NumberField label="x" name={`${id}, x in metres`} value={x} low={-limits.stageM} high={limits.stageM} step={0.1} rule="x is metres to the left, seen from her" set={(value) => put({ x: value, z })} />
        <NumberField label="z" name={`${id}, z in metres`} value={z} low={-limits.stageM} high={limits.stageM} step={0.1} rule="z is metres towards the audience" set={(value) => put({ x, z: value })} />
        <NumberField label="faces" name={`${id}, degrees that her dance is turned`} value={facing} low={-360} high={360} step={5} rule="Her dance turns -360 to 360 degrees" set={(value) => set({ facing: value })} />
        <NumberField label="later" name={`${id}, ${inCounts ? 'counts' : 'seconds'} later`} value={after} low={0} high={longest} step={1}
          rule={`She may start 0 to ${longest} ${inCounts ? 'counts' : 'seconds'} later`} set={(value) => set({ after: value })} />
      </div>
      <div class="row">
        <label class="check"><input type="checkbox" checked={mirrored} onChange={(event) => set({ mirrored: event.currentTarget.checked })} />Mirrored</label>
        <button aria-pressed={seed !== null} title="The same keys, danced differently" onClick={() => set({ seed: seed === null ? studio.project.value.seed + 1 + nth : null })}>Dances differently</button>
        <button aria-pressed={keys !== null} title="Keys of her own instead of the keys of all" onClick={() => set({ keys: keys === null ? [...studio.project.value.keys] : null })}>Own keys</button>
        {keys && <button title="Show her keys above, to set and move them; the others' keys stay" onClick={() => studio.workOnDanceOf(nth)}>Work on her keys</button>}
        <button aria-label={`Remove ${id}`} class="icon" title="Remove" onClick={() => studio.removePartner(nth)}>×</button>
      </div>
      {isPlain && nth > 0 && <p class="small">The same dance at another place.</p>}
    </fieldset>
  );
}

/// How near the dancers come, and by how much the formation was widened.
function Distance() {
  const formed = studio.formation.value;
  if (!formed || formed.reply.least === undefined) return null;
  const { widened, least, one, other, at } = formed.reply;
  const { dancers } = formed.of.project;
  return (
    <p class="small" role="status">
      {dancers[one].id} and {dancers[other].id} come nearest, to {least.toFixed(2)} m at {at.toFixed(1)} s.
      {widened > 1 && ` All places are ${widened.toFixed(2)} times as far from their middle, so that nobody touches another.`}
    </p>
  );
}

export function DancersPanel() {
  const { value } = studio.project;
  const partners = value?.dancers ?? [];
  return (
    <section aria-label="Dancers">
      <h2>Dancers</h2>
      {partners.length === 0 && <p class="small">One dancer. Others can dance with her: mirrored, counts later, or differently.</p>}
      {partners.map((partner, nth) => <PartnerFields key={partner.id} partner={partner} nth={nth} />)}
      <Distance />
      <div class="row">
        <button disabled={!value} onClick={studio.addPartner}>Add a dancer</button>
        {partners.length > 1 && <button title="Turn each to the one nearest to her, as they begin" onClick={studio.faceEachOther}>Face to face</button>}
      </div>
    </section>
  );
}
