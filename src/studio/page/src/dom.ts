// Makes elements of the page.

export function button(text: string, title: string, action: () => void): HTMLButtonElement {
  const element = document.createElement('button');
  element.textContent = text;
  element.title = title;
  element.addEventListener('click', action);
  return element;
}

export function labelled(text: string, ...content: HTMLElement[]): HTMLLabelElement {
  const label = document.createElement('label');
  label.append(text, ...content);
  return label;
}

export function input(type: string, label: string, value: string,
                      take: (field: HTMLInputElement) => void): HTMLInputElement {
  const field = document.createElement('input');
  field.type = type;
  field.setAttribute('aria-label', label);
  if (type === 'number') field.step = 'any';
  field.value = value;
  field.addEventListener('input', () => take(field));
  return field;
}

export function choice(label: string, options: readonly (readonly [string, string])[],
                       take: (value: string) => void): HTMLSelectElement {
  const list = document.createElement('select');
  list.setAttribute('aria-label', label);
  list.append(...options.map(([value, text]) => new Option(text, value)));
  list.addEventListener('change', () => take(list.value));
  return list;
}

const svgSpace = 'http://www.w3.org/2000/svg';

export function svg<Name extends keyof SVGElementTagNameMap>(
    name: Name, attributes: Record<string, string | number> = {}): SVGElementTagNameMap[Name] {
  const element = document.createElementNS(svgSpace, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  return element;
}
