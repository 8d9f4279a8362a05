import { render } from 'preact';
import { App, stage } from './app';
import { Figure } from './body';
import type { Pose } from './body';
import * as studio from './studio';

/// The world position of a pose's joint, metres.
const place = (pose: Pose, joint: string) =>
  new Figure(studio.skeleton, pose).places[studio.skeleton.find(joint)].toArray();

// For the browser's console, and for tests.
Object.assign(window, { choreo: { ...studio, stage, place } });
render(<App />, document.getElementById('studio')!);
