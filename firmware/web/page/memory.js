// What this screen remembers between visits. A browser that allows no storage forgets, and that is all.

export function recall(key) {
  try {
    return localStorage.getItem(`ivo.${key}`);
  } catch {
    return null;
  }
}

export function remember(key, value) {
  try {
    localStorage.setItem(`ivo.${key}`, value);
  } catch {
    // As said above.
  }
}
