// The program behind the page, and its description of body and model.
import { Skeleton } from '../project/body';
import { Dancer } from '../project/dancer';
import type { Welcome } from '../generated/studio/studio_pb';
import { setLimits } from '../project/limits';
import { showError, isConnected, welcome } from '../project/state';
import { Wire } from '../project/wire';

export let skeleton: Skeleton;
export let dancer: Dancer;

let onWelcome: (received: Welcome, isFirst: boolean) => void = () => {};
/// Registers what to do when the program connects or reconnects.
export const whenConnected = (does: typeof onWelcome) => (onWelcome = does);

export const wire = new Wire(
  ({ response }) => {
    if (response.case !== 'welcome') return;
    const isFirst = !welcome.value;
    skeleton = new Skeleton(response.value.model!.skeleton!);
    dancer = new Dancer(wire, response.value.model!);
    setLimits(response.value.limits!);
    welcome.value = response.value;
    isConnected.value = true;
    onWelcome(response.value, isFirst);
  },
  () => {
    if (isConnected.value) showError(new Error('The studio program is gone. Trying again each second.'));
    isConnected.value = false;
  },
);
