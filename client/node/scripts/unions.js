// The tool declares all alternatives of a oneof as optional members, side by side, so that asking which one came tells the compiler nothing.

const member = /(?: {2}\/\*\*\n(?: {3}\*.*\n)*? {3}\*\/\n)? {2}'(\w+)'\??: (.*);\n/g;

/** The declaration `text` of the message `type`, where what comes of its oneofs is a union that narrows by the oneof's name or by what is there. */
export function withUnions(text, type) {
  const oneofs = (type.oneofsArray ?? []).filter(({ name }) => !name.startsWith('_')); // others stand for single optional fields
  return oneofs.length === 0 ? text : text.replace(/^export interface (\w+__Output) \{\n([^]*?)^\}/m, (_, name, body) => union(name, body, oneofs));
}

function union(name, body, oneofs) {
  const members = [...body.matchAll(member)].map(([whole, field, kind]) => ({ whole, field, kind }));
  const isCommon = ({ field }) => !oneofs.some((oneof) => oneof.name === field || oneof.oneof.includes(field));
  const common = members.filter(isCommon).map(({ whole }) => whole);
  return `export type ${name} = {\n${common.join('')}}${oneofs.map((oneof) => choice(oneof, members)).join('')};`;
}

/** One of a oneof's fields, or, of a newer server, none that is known. */
function choice({ name, oneof }, members) {
  const alternatives = [undefined, ...oneof].map((chosen) => {
    const others = oneof.filter((field) => field !== chosen).map((field) => `  '${field}'?: undefined;\n`);
    const { whole, kind } = members.find(({ field }) => field === chosen) ?? {};
    const own = whole?.replace(`'${chosen}'?: ${kind}`, `'${chosen}': ${kind.replace(' | null', '')}`) ?? '';
    return `  | {\n  '${name}'${chosen ? `: '${chosen}'` : '?: undefined'};\n${own}${others.join('')}}`;
  });
  return ` & (\n${alternatives.join('\n')}\n)`;
}
