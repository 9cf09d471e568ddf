// Shows the little Markdown that the reference has. It makes elements and never parses HTML.

function addInline(parent: HTMLElement, text: string): void {
  for (const piece of text.split(/(\*\*[^*]*\*\*|`[^`]*`|\[[^\]]*\]\([^)]*\))/)) {
    const link = /^\[([^\]]*)\]\(/.exec(piece);
    if (piece.startsWith('`') && piece.length > 1) {
      parent.append(Object.assign(document.createElement('code'), {textContent: piece.slice(1, -1)}));
    } else if (piece.startsWith('**') && piece.length > 3) {
      const bold = document.createElement('b');
      addInline(bold, piece.slice(2, -2));
      parent.append(bold);
    } else {
      parent.append(link ? link[1]! : piece);
    }
  }
}

export function markdown(text: string): HTMLElement {
  const result = document.createElement('div');
  for (const block of text.split(/\n{2,}/)) {
    const fence = /^```\w*\n([\s\S]*?)\n?```$/.exec(block.trim());
    if (fence) {
      result.append(Object.assign(document.createElement('pre'), {textContent: fence[1]!}));
    } else if (/^- /.test(block)) {
      const list = document.createElement('ul');
      for (const line of block.split(/\n(?=- )/)) {
        const item = document.createElement('li');
        addInline(item, line.slice(2));
        list.append(item);
      }
      result.append(list);
    } else {
      const paragraph = document.createElement('p');
      addInline(paragraph, block.replace(/\n/g, ' '));
      result.append(paragraph);
    }
  }
  return result;
}
