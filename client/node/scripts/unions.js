// The tool declares all alternatives of a oneof as optional members, side by side, and everything that is sent as optional: asking which one came
// tells the compiler nothing, and a request that lacks what it needs passes it.

const member = /(?: {2}\/\*\*\n(?<said>(?: {3}\*.*\n)*?) {3}\*\/\n)? {2}'(?<field>\w+)'\??: (?<kind>.*);\n/g;
const needed = /\bRequired[.;]/;
/** Messages all of whose fields are needed: proto3 has no way to say so, and takes an axis that is left out as 0. */
const whole = ['Vector3'];

/**
 * The declarations `text` of the message `type`, where oneofs are unions. Those that come narrow by the oneof's name or by what is there. Those that
 * are sent are of interfaces that have names, one for each choice, so that the compiler's errors name the one that was meant.
 */
export function withUnions(text, type) {
  const oneofs = (type.oneofsArray ?? []).filter(({ name }) => !name.startsWith('_')); // others stand for single optional fields
  return text.replace(/^export interface (\w+) \{\n([^]*?)^\}/gm, (_, name, body) => {
    const members = [...body.matchAll(member)].map(({ 0: whole, groups }) => ({ whole, ...groups }));
    return declared(name, members, oneofs);
  });
}

function declared(name, members, oneofs) {
  const comes = name.endsWith('__Output');
  const isCommon = ({ field }) => !oneofs.some((oneof) => oneof.name === field || oneof.oneof.includes(field));
  const common = members.filter(isCommon).map((one) => (comes ? one.whole : whole.includes(name) ? certain(one.whole, one.kind, one.field) : asNeeded(one)));
  if (oneofs.length === 0) return `export interface ${name} {\n${common.join('').replace(/^ {2}'(\w+)'/gm, '  $1')}}`;
  if (!comes && oneofs.length === 1) return alternatives(name, members, common, oneofs[0]);
  return `export type ${name} = {\n${common.join('')}}${oneofs.map((oneof) => choice(oneof, members, comes)).join('')};`;
}

const asNeeded = ({ whole, field, kind, said }) => {
  return needed.test(said ?? '') ? whole.replace(`'${field}'?: ${kind}`, `'${field}': ${kind.replace(' | null', '')}`) : whole;
};

const mayLack = ({ name }, members) => !needed.test(members.find(({ field }) => field === name).said ?? '');
const certain = (whole, kind, field) => whole.replace(`'${field}'?: ${kind}`, `'${field}': ${kind?.replace(' | null', '')}`);

function alternatives(name, members, common, oneof) {
  const lines = [`export interface ${name}Fields {\n${common.join('')}}`];
  const names = oneof.oneof.map((chosen) => {
    const { whole, kind } = members.find(({ field }) => field === chosen);
    const own = mayLack(oneof, members) ? whole : certain(whole, kind, chosen);
    const ofIt = name + chosen.replace(/(?:^|_)(\w)/g, (_, letter) => letter.toUpperCase()).replace(/^/, 'With');
    // Beside other fields these would hide from the compiler which choice was meant; there Exactly looks for two.
    const others = common.length > 0 ? [] : oneof.oneof.filter((field) => field !== chosen).map((field) => `  '${field}'?: null;\n`);
    lines.push(`export interface ${ofIt} extends ${name}Fields {\n  '${oneof.name}'?: '${chosen}';\n${own}${others.join('')}}`);
    return ofIt;
  });
  return [...lines, `export type ${name} = ${names.join(' | ')};`].join('\n\n').replace(/^ {2}'(\w+)'/gm, '  $1');
}

/** One of a oneof's fields; or none: of a newer server, or where the API needs none. */
function choice({ name, oneof }, members, comes) {
  const lacks = !comes && mayLack({ name }, members);
  const alternatives = [...(comes ? [undefined] : []), ...oneof].map((chosen) => {
    const others = oneof.filter((field) => field !== chosen).map((field) => `  '${field}'?: ${comes ? 'undefined' : 'null'};\n`);
    const { whole = '', kind } = members.find(({ field }) => field === chosen) ?? {};
    const own = lacks ? whole : certain(whole, kind, chosen);
    const which = chosen ? `'${name}'${comes ? '' : '?'}: '${chosen}'` : `'${name}'?: undefined`;
    return `  | {\n  ${which};\n${own}${others.join('')}}`;
  });
  return ` & (\n${alternatives.join('\n')}\n)`;
}
