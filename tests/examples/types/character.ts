import { bonesOf, Character, gltfBones, Player, type Bone } from 'choreo-client/character';
import { ChoreoClient, type StreamDanceResponse } from 'choreo-client';
declare const scene: { children: { name: string; children: never[] }[]; frame: number };
const { bones, objects } = bonesOf(scene);
const made: Bone[] = gltfBones({ nodes: [] });
let character: Character;
let player: Player;
let dance: ReturnType<Character['dance']>;
export function hear(answer: StreamDanceResponse): void {
  if (answer.header?.skeleton) {
    character = new Character(bones.concat(made), answer.header.skeleton, { map: { left_foot: null } });
    dance = character.dance(answer.header);
    player = new Player(answer.header, { keep: 1 });
  }
  if (answer.frames) player.add(dance.add(answer.frames));
  const { state, pose } = player.at(1);
  if (state === 'playing' && pose) character.show(pose, objects);
  // @ts-expect-error: no such option
  new Character(bones, answer.header!.skeleton!, { bones: {} });
}
new ChoreoClient('one:1').close();
