// Asks by a bar that keeps nobody from going on.

export function ask(question: string, answers: Record<string, () => void>): void {
  const bar = document.getElementById('question')!;
  const buttons = Object.entries(answers).map(([text, action]) => {
    const button = document.createElement('button');
    button.textContent = text;
    button.addEventListener('click', () => {
      bar.replaceChildren();
      action();
    });
    return button;
  });
  bar.replaceChildren(question, ...buttons);
}
