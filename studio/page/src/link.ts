// The program behind the page, and its description of body and model.
import { Skeleton } from './body';
import { Dancer } from './dancer';
import type { Welcome } from './generated/studio/studio_pb';
import { setLimits } from './limits';
import { complain, isConnected, welcome } from './state';
import { Wire } from './wire';

export let skeleton: Skeleton;
export let dancer: Dancer;

let greet: (received: Welcome, isFirst: boolean) => void = () => {};
/// Registers what to do when the program connects or reconnects.
export const whenThere = (does: typeof greet) => (greet = does);

export const wire = new Wire(
  ({ response }) => {
    if (response.case !== 'welcome') return;
    const isFirst = !welcome.value;
    skeleton = new Skeleton(response.value.model!.skeleton!);
    dancer = new Dancer(wire, response.value.model!);
    setLimits(response.value.limits!);
    welcome.value = response.value;
    isConnected.value = true;
    greet(response.value, isFirst);
  },
  () => {
    if (isConnected.value) complain(new Error('The studio program is gone. Trying again each second.'));
    isConnected.value = false;
  },
);
