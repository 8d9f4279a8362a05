import { render } from 'preact';
import { App, stage } from './app';
import { Figure } from './project/body';
import type { Pose } from './project/body';
import * as studio from './session/studio';

/// The world position of a pose's joint, metres.
const place = (pose: Pose, joint: string) =>
  new Figure(studio.skeleton, pose).places[studio.skeleton.find(joint)].toArray();

// For the browser's console, and for tests.
Object.assign(window, { choreo: { ...studio, stage, place } });
render(<App />, document.getElementById('studio')!);
