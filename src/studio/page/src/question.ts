// Asks by a bar that keeps nobody from going on.

import {button} from './dom';

const bar = () => document.getElementById('question')!;

export function ask(question: string, answers: Record<string, () => void>): void {
  const buttons = Object.entries(answers).map(([text, action]) =>
    button(text, '', () => {
      endQuestion();
      action();
    }));
  bar().replaceChildren(question, ...buttons);
}

/** Takes away a question that has answered itself. */
export function endQuestion(): void {
  bar().replaceChildren();
}
