// For browsers and Node.js, without any dependency: the frames of a dance become the bones' turns of a character of one's own, as
// `choreo convert --character` makes them, and are shown by a clock.

/** A node of a character, as it rests. In glTF and three.js bones and other nodes are in one tree: give all of them. */
export interface Bone {
  name: string;
  /** Its number among the bones; -1: none. */
  parent: number;
  /** In its parent: [x, y, z]; a quaternion [x, y, z, w]; [x, y, z]. */
  position: ArrayLike<number>;
  rotation: ArrayLike<number>;
  scale: ArrayLike<number>;
  /** Whether a skin uses it, and whether it is a mesh: these tell bones from others of the same name. */
  isBone?: boolean;
  isMesh?: boolean;
  /** What a VRM calls it, as in 'leftUpperLeg'. */
  humanoid?: string;
}

/** An Object3D of three.js, or alike. */
export interface Object3D {
  name: string;
  children: Object3D[];
  userData?: Record<string, any>;
  position: { toArray(): number[]; fromArray(list: ArrayLike<number>, at?: number): unknown };
  quaternion: { toArray(): any[]; fromArray(list: ArrayLike<number>, at?: number): unknown };
  scale: { toArray(): number[] };
}

/**
 * The bones of what lies below `root`, such as `gltf.scene`, in its frame, as they rest now, with their `objects`, in the same order. `humanoid`:
 * three-vrm's `vrm.humanoid.humanBones`.
 */
export function bonesOf<T extends { children: any[] }>(
  root: T,
  humanoid?: Record<string, { node: unknown } | undefined>,
): { bones: Bone[]; objects: T['children'] };

/** The nodes of a glTF or VRM file, of its JSON, in its order. */
export function gltfBones(json: object): Bone[];

/** What a dance's header says of its body, smpl24. */
export interface Smpl {
  name: string;
  joint_names: string[];
  parents: number[];
  offsets: number[];
  pelvis_height: number;
}

/** A dance's frames, as its messages have them, in any encoding. */
export interface SmplFrames {
  first_frame: string | number;
  count: number;
  root_positions: ArrayLike<number>;
  rotations: ArrayLike<number>;
}

/** The bones of a frame, in their parents. */
export interface CharacterPose {
  frame: number;
  /** A quaternion [x, y, z, w] for each node of Character.turning, one after the other. */
  turns: number[];
  /** [x, y, z] for each node of Character.moving. */
  places: number[];
}

export type Hands = 'rest' | 'relaxed' | 'open' | 'fist' | 'point';

/** A character's bones. The dance stays in the frame of the bones' roots: Y up, metres at SMPL's size, ahead is +Z. */
export class Character {
  /**
   * `bones`: as they rest: upright, arms hanging, held out or in between. They are found by `map`, {bone: name, number or null}, where it says so,
   * then by `humanoid`, then by their names: those of Mixamo, VRM, Unity, Unreal, Rigify and many more (docs/character.md). `skeleton`: of the
   * dance's header. `inPlace`: it stays above the origin. `hands`: what fingers do, relaxed by default; 'rest': as they rest.
   * Throws TypeError for bones that are no body.
   */
  constructor(bones: Bone[], skeleton: Smpl, options?: { map?: Record<string, string | number | null>; inPlace?: boolean; hands?: Hands });
  /** The number of each bone that was found, as in {pelvis: 3, left_hip: 4}. */
  readonly bones: Readonly<Record<string, number>>;
  /** The nodes whose turns a pose has, and those whose places: the pelvis and bones that do not hang from the bone above. */
  readonly turning: readonly number[];
  readonly moving: readonly number[];
  /**
   * Takes a dance's messages in turn and returns the poses that are settled by now; `end` returns the rest. Hands foresee what they will touch, so
   * poses come a quarter of a second after their frames. `header`: of the dance.
   */
  dance(header: { frame_rate: number }): { add(frames: SmplFrames): CharacterPose[]; end(): CharacterPose[] };
  /** Gives a pose, if there is one yet, to the objects of bonesOf(). */
  show(pose: Pick<CharacterPose, 'turns' | 'places'> | undefined, objects: ArrayLike<unknown>): void;
}

/** A message's frames as poses of SMPL's own joints: a quaternion for each, and the root's place. For a Player, without a character. */
export function smplPoses(frames: SmplFrames, skeleton: Pick<Smpl, 'joint_names'>): CharacterPose[];

export interface PlayerOptions {
  /** Seconds of the past to keep, for a clock that goes back; default 2. Infinity: all, for a clock that seeks. */
  keep?: number;
  /** Seconds in which a dancer who had to wait for poses comes back to the dance; default 0.3. */
  catchUp?: number;
}

/** What to show at a time. */
export interface Shown {
  /**
   * 'waiting': the dance has not come, or not begun; its first pose, if it has come. 'playing': between two poses. 'starved': the poses are late;
   * the last one, and later the way back. 'past': the poses of that time are forgotten; the first one that is kept. 'over': the last pose, after
   * end().
   */
  state: 'waiting' | 'playing' | 'starved' | 'past' | 'over';
  pose?: Pick<CharacterPose, 'turns' | 'places'>;
  /** Seconds until it starves. */
  ahead: number;
}

/** Shows poses by a clock: that of an <audio> element, say, as often as a page draws. */
export class Player {
  constructor(header: { frame_rate: number }, options?: PlayerOptions);
  /** Poses in any order. A frame that comes again replaces the one before; what is past is forgotten. */
  add(poses: Iterable<CharacterPose>): void;
  /** No more will come. */
  end(): void;
  at(seconds: number): Shown;
  /** Seconds of poses that are there beyond this time: start music with half a second or so. */
  ahead(seconds: number): number;
}
