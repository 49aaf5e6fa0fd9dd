// The line to the solve: createLink(token, {onMessage, onState}) -> {say(message)}. Messages are those of levade.viewer.watching. onState is
// told "open", "waiting" (it tries again by itself) or "gone".

export function createLink(token, { onMessage, onState }) {
  const source = new EventSource(`events?token=${encodeURIComponent(token)}`);
  let ended = false;
  source.onopen = () => onState("open");
  source.onmessage = ({ data }) => {
    const message = JSON.parse(data);
    if (message.verdict) {
      ended = true; // nothing more will come, and the server may go: no reason to call again
      source.close();
    }
    onMessage(message);
  };
  source.onerror = () => {
    if (!ended) onState(source.readyState === EventSource.CLOSED ? "gone" : "waiting");
  };

  // Resolves to null, or to what is wrong.
  async function say(message) {
    try {
      const answer = await fetch("command", {
        method: "POST",
        headers: { "Content-Type": "application/json", "X-Levade-Token": token },
        body: JSON.stringify(message),
      });
      return answer.ok ? null : (await answer.text()).trim();
    } catch {
      return "The solve does not answer.";
    }
  }

  return { say };
}
