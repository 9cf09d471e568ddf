// Makes the tabs of panels reachable by the keyboard, and says what they are.

import type {DockviewApi} from 'dockview-core';

const tabSelector = '.dv-tab';

/** Follows the tabs of a dock. Enter shows a panel, arrows go along its row, Delete closes it. */
export function nameTabs(root: HTMLElement, dock: DockviewApi): void {
  const name = () => {
    for (const row of root.querySelectorAll('.dv-tabs-container')) {
      row.setAttribute('role', 'tablist');
      row.setAttribute('aria-label', 'Panels');
    }
    for (const tab of root.querySelectorAll<HTMLElement>(tabSelector)) {
      const isActive = tab.classList.contains('dv-active-tab');
      tab.setAttribute('role', 'tab');
      tab.setAttribute('aria-selected', String(isActive));
      tab.tabIndex = isActive ? 0 : -1;
      const cross = tab.querySelector('.dv-default-tab-action');
      cross?.setAttribute('title', 'Close (Delete)');
      cross?.setAttribute('aria-hidden', 'true');
    }
  };
  // Dockview adds tabs and changes their classes, and says so too late or not at all.
  new MutationObserver(name).observe(root, {
    subtree: true, childList: true, attributes: true, attributeFilter: ['class']});
  name();

  root.addEventListener('keydown', (event) => {
    const tab = event.target as HTMLElement;
    if (!tab.matches(tabSelector)) return;
    const panel = dock.panels.find(({title}) => title === tab.textContent);
    const next = event.key === 'ArrowRight' ? tab.nextElementSibling :
      event.key === 'ArrowLeft' ? tab.previousElementSibling : null;
    if (event.key === 'Enter' || event.key === ' ') panel?.api.setActive();
    else if (event.key === 'Delete') panel?.api.close();
    else if (next?.matches(tabSelector)) (next as HTMLElement).focus();
    else return;
    event.preventDefault();
  });
}
