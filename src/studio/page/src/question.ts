// Asks by a bar that keeps nobody from going on.

import {button} from './dom';

export function ask(question: string, answers: Record<string, () => void>): void {
  const bar = document.getElementById('question')!;
  const buttons = Object.entries(answers).map(([text, action]) =>
    button(text, '', () => {
      bar.replaceChildren();
      action();
    }));
  bar.replaceChildren(question, ...buttons);
}
