// Messages with the fields that they have, and no others.

type Plain = string | number | bigint | boolean | symbol | null | undefined | ArrayBuffer | ArrayBufferView | readonly unknown[] | { low: number; high: number };
export type Known<S> = S extends unknown ? keyof S : never;
export type Used<T> = { [K in keyof T]-?: [NonNullable<T[K]>] extends [never] ? never : K }[keyof T];
/** The alternatives in `S` that have all fields used in `T`. */
type Fitting<T, S> = S extends unknown ? (Used<T> extends Used<S> ? S : never) : never;
export type Of<S, K extends PropertyKey> = S extends unknown ? (K extends keyof S ? NonNullable<S[K]> : never) : never;
/** `K` if one of the alternatives `S` lacks it, otherwise never. */
type Lacking<S, K> = S extends unknown ? (K extends Used<S> ? never : K) : never;
/** The type, which doubles as an error message, of a field that does not fit. */
type Misfit<S, K> = K extends Known<S> ? ([Lacking<S, K>] extends [never] ? unknown : 'another field of this message excludes this one') : `there is no field ${K & string}`;
/**
 * A message of type `S` with the fields of `T`. Fields that `S` lacks, or that exclude each other, have a type that states the error. It is needed
 * because the compiler checks for such fields only in literals, and not in the values that a generator yields.
 */
export type Exactly<T, S> = T extends Plain
  ? T
  : [Fitting<T, S>] extends [never]
    ? { [K in keyof T]: Misfit<S, K> }
    : { [K in keyof T]: Exactly<T[K], Of<Fitting<T, S>, K>> };
