// What the browser keeps for this address from one visit to the next.

/** Keeps texts while the page is open. */
class Forgetful implements Pick<Storage, 'getItem' | 'setItem' | 'removeItem'> {
  private readonly texts = new Map<string, string>();
  getItem(key: string) { return this.texts.get(key) ?? null; }
  setItem(key: string, text: string) { this.texts.set(key, text); }
  removeItem(key: string) { this.texts.delete(key); }
}

/** Browsers may give nothing to a frame in a page of another site, such as a notebook. */
function open(): Pick<Storage, 'getItem' | 'setItem' | 'removeItem'> {
  try {
    return window.localStorage;
  } catch {
    return new Forgetful();
  }
}

export const storage = open();
