#!/usr/bin/python3
"""The page's words: the same sentences in both languages, and no English on a Spanish screen."""

import os
import re
import unittest

from console_rig import ConsoleTest, courtyard

WORDS = """const done = arguments[0];
Promise.all([import("/words_en.js"), import("/words_es.js")]).then(([en, es]) => done([en.words, es.words]), (fault) => done(String(fault)))"""
# Text nodes and labels that somebody can see.
SEEN = """const seen = [];
const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
while (walk.nextNode()) {
  const node = walk.currentNode;
  if (node.textContent.trim() !== "" && node.parentElement.checkVisibility() && !["SCRIPT", "NOSCRIPT"].includes(node.parentElement.tagName)) seen.push(node.textContent.trim());
}
for (const node of document.querySelectorAll("[aria-label]")) if (node.checkVisibility()) seen.push(node.getAttribute("aria-label"));
return seen"""


class Words(ConsoleTest):
    def test_spanish(self):
        self.begin()
        screen = self.screen("Tableta de Ana", "tablet", language="es")
        english, spanish = screen.browser.driver.execute_async_script(WORDS)
        self.assertEqual(sorted(english), sorted(spanish))
        for key, words in english.items():
            self.assertEqual(set(re.findall(r"\{\w+\}", words)), set(re.findall(r"\{\w+\}", spanish[key])), key)
        # Of a sentence with gaps, whatever stands in them.
        only_english = [re.compile(re.sub(r"\\\{\w+\\\}", ".+", re.escape(words)))
                        for words in english.values() if words not in spanish.values() and len(re.findall(r"[a-z]{3,}", re.sub(r"\{\w+\}", "", words))) > 0]

        def assert_spanish(name):
            screen.wait("document.documentElement.lang === 'es'")
            self.assertEqual([text for text in screen.js(SEEN) if any(words.fullmatch(text) for words in only_english)], [], name)
            screen.judge(f"spanish-{name}")

        screen.press_until("take-control", "document.body.dataset.act === 'accept'")
        assert_spanish("agree")
        for tab in ("areas", "screens", "search"):
            screen.press(f"tab-{tab}")
            assert_spanish(tab)
        screen.start()
        assert_spanish("searching")
        screen.press("language")
        screen.wait_text("state", "IVO is searching")
        screen.press("language")
        screen.wait("document.documentElement.lang === 'es'")
        screen.browser.driver.refresh()
        screen.wait_stage("search")
        assert_spanish("reloaded")

    def test_a_fault_says_where_to_look(self):
        script = os.path.join(self.folder, "script.toml")
        with open(script, "w", encoding="utf-8") as file:
            file.write('[[at]]\nt_s = 6.0\ndrive = "rear_left"\nfault = "reboot"\n')
        self.start_controller(courtyard("unknown"), "--script", script)
        self.start_server()
        screen = self.screen("Tableta de Ana", "tablet", language="es")
        screen.wait_stage("fault")
        screen.wait_text("now-text", "La rueda trasera izquierda avisa de un fallo de su motor. ")
        self.assertEqual(screen.text("fault-detail"), "drive 3 (rear left): rebooted")
        screen.judge("spanish-fault")
        screen.press("language")
        screen.wait_text("now-text", "The rear left wheel reported a fault of its motor. ")
        screen.judge("fault")


if __name__ == "__main__":
    unittest.main()
