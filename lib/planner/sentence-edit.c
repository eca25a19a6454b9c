/* Words and options of a sentence changed as text (sentence-edit.h). A vertical bar between quotes separates nothing.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "planner/sentence-edit.h"

static const char blanks[] = " \t\n";

static void trim(char *word)
{
	const size_t lead = strspn(word, blanks);
	memmove(word, word + lead, strlen(word + lead) + 1);
	for (size_t n = strlen(word); n && strchr(blanks, word[n - 1]); n--)
		word[n - 1] = 0;
}

bool pm_edit_read(struct pm_edit *e, const char *sentence)
{
	char quote = 0;
	size_t at = 0;
	e->n = 0;
	for (const char *c = sentence;; c++) {
		if (*c == '#' && !quote && (c == sentence || strchr(blanks, c[-1])))
			c += strcspn(c, "\n");
		if (!*c || (*c == '|' && !quote)) {
			e->word[e->n][at] = 0;
			trim(e->word[e->n++]);
			at = 0;
			if (!*c)
				return true;
			if (e->n == PM_PLAN_WORDS)
				return false;
			continue;
		}
		quote = quote ? (*c == quote ? 0 : quote) : *c == '\'' || *c == '"' ? *c : 0;
		if (at + 1 == PM_EDIT_WORD)
			return false;
		e->word[e->n][at++] = *c;
	}
}

bool pm_edit_write(const struct pm_edit *e, char sentence[PM_PLAN_TEXT])
{
	size_t at = 0;
	sentence[0] = 0;
	for (int i = 0; i < e->n && at < PM_PLAN_TEXT; i++)
		at += (size_t)snprintf(sentence + at, PM_PLAN_TEXT - at, "%s%s", i ? " | " : "", e->word[i]);
	return at < PM_PLAN_TEXT;
}

int pm_edit_find(const struct pm_edit *e, const char *name, int from)
{
	for (int i = from; i < e->n; i++)
		if (strcspn(e->word[i], blanks) == strlen(name) && !strncmp(e->word[i], name, strlen(name)))
			return i;
	return -1;
}

/* Is the argument at `token`, n long, the option? joined: as --name=value. */
static bool is_option(const char *token, size_t n, struct pm_edit_option o, bool *joined)
{
	const size_t name = strlen(o.name);
	*joined = n > name + 3 && token[name + 2] == '=';
	if (n == 2 && token[0] == '-' && token[1] == o.letter)
		return true;
	return n >= name + 2 && !strncmp(token, "--", 2) && !strncmp(token + 2, o.name, name) && (n == name + 2 || *joined);
}

/* Where the option begins in a word, and where its value does and how long it is; NULL: not given. */
static char *place(char *word, struct pm_edit_option o, char **value, size_t *length)
{
	for (char *t = word + strcspn(word, blanks); *(t += strspn(t, blanks));) {
		const size_t n = strcspn(t, blanks);
		bool joined;
		if (is_option(t, n, o, &joined)) {
			*value = joined ? t + strlen(o.name) + 3 : t + n + strspn(t + n, blanks);
			*length = strcspn(*value, blanks);
			return t;
		}
		t += n;
	}
	return NULL;
}

bool pm_edit_value(const struct pm_edit *e, int word, struct pm_edit_option o, char value[64])
{
	char copy[PM_EDIT_WORD], *at;
	size_t n;
	memcpy(copy, e->word[word], sizeof copy);
	if (!place(copy, o, &at, &n) || n >= 64)
		return false;
	memcpy(value, at, n);
	value[n] = 0;
	return true;
}

bool pm_edit_says(const struct pm_edit *e, int word, const char *token)
{
	for (const char *t = e->word[word] + strcspn(e->word[word], blanks); *(t += strspn(t, blanks)); t += strcspn(t, blanks))
		if (strcspn(t, blanks) == strlen(token) && !strncmp(t, token, strlen(token)))
			return true;
	return false;
}

bool pm_edit_set(struct pm_edit *e, int word, struct pm_edit_option o, const char *value)
{
	char *w = e->word[word], text[PM_EDIT_WORD], *at, *from;
	size_t n;
	if ((from = place(w, o, &at, &n))) {
		const char *rest = at + n + strspn(at + n, blanks);
		memmove(from, rest, strlen(rest) + 1);
		trim(w);
	}
	if (!value)
		return true;
	const size_t name = strcspn(w, blanks);
	const int all = snprintf(text, sizeof text, "%.*s --%s %s%s", (int)name, w, o.name, value, w + name);
	if (all < 0 || (size_t)all >= sizeof text)
		return false;
	memcpy(w, text, sizeof text);
	return true;
}

void pm_edit_remove(struct pm_edit *e, int word)
{
	e->n--;
	memmove(e->word[word], e->word[word + 1], (size_t)(e->n - word) * sizeof e->word[0]);
}
