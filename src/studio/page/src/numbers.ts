// Numbers as scripts have them.

/** Writes a number with so many digits as are of use in a script. */
export function numberText(value: number): string {
  return String(Number(value.toPrecision(7)));
}

export function vectorText(name: string, numbers: readonly number[]): string {
  return `${name}(${numbers.map(numberText).join(', ')})`;
}

/** Writes a string as the language has it. */
export function stringText(text: string): string {
  return `"${text.replace(/[\\"]/g, '\\$&').replace(/\n/g, '\\n').replace(/\t/g, '\\t')}"`;
}
