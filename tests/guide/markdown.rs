//! The parts of a Markdown page that the tests need.

use pulldown_cmark::{CodeBlockKind, Event, Options, Parser, Tag, TagEnd};
use std::collections::HashMap;
use std::ops::Range;

/// A fenced block of code.
#[derive(Debug)]
pub struct Block {
    /// First word after the fence: "sh", "python", ...
    pub language: String,
    pub text: String,
    /// Its position in the page, including its fences.
    pub range: Range<usize>,
    /// The HTML comment immediately before it.
    pub comment: Option<String>,
    /// The file named in the text before it: "Save this as `ball.toml`".
    pub file: Option<String>,
}

#[derive(Debug, Default)]
pub struct Page {
    pub blocks: Vec<Block>,
    /// Targets of links and images.
    pub links: Vec<String>,
    /// Inline code.
    pub code: Vec<String>,
    /// The identifiers of its headings, as GitHub and mdBook make them.
    pub anchors: Vec<String>,
}

/// The content since the last block of code.
#[derive(Default)]
struct Before {
    comment: Option<String>,
    /// The paragraph so far, and the last inline code in it.
    paragraph: String,
    code: Option<String>,
}

impl Page {
    pub fn parse(text: &str) -> Page {
        let mut page = Page::default();
        let (mut before, mut heading, mut block) = (Before::default(), None::<String>, None::<Block>);
        for (event, range) in Parser::new_ext(text, Options::ENABLE_TABLES).into_offset_iter() {
            match event {
                Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(info))) => {
                    let Before { comment, paragraph, code } = std::mem::take(&mut before);
                    let language = info.split_whitespace().next().unwrap_or_default().to_string();
                    let file = code.filter(|_| paragraph.contains("Save this as"));
                    block = Some(Block { language, text: String::new(), range, comment, file });
                }
                Event::End(TagEnd::CodeBlock) => page.blocks.extend(block.take()),
                Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                    page.links.push(dest_url.to_string());
                }
                Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
                Event::End(TagEnd::Heading(_)) => page.anchors.extend(heading.take().map(|text| anchor(&text))),
                Event::Start(Tag::Paragraph) => before = Before::default(),
                Event::Html(html) => before.comment = comment(&html).or(before.comment),
                Event::Text(text) => match (&mut block, &mut heading) {
                    (Some(block), _) => block.text += &text,
                    (None, Some(heading)) => *heading += &text,
                    (None, None) => before.paragraph += &text,
                },
                Event::Code(code) => {
                    if let Some(heading) = &mut heading {
                        *heading += &code;
                    }
                    before.code = Some(code.to_string());
                    page.code.push(code.to_string());
                }
                _ => {}
            }
        }
        page.anchors = numbered(page.anchors);
        page
    }
}

/// The text of an HTML comment.
fn comment(html: &str) -> Option<String> {
    Some(html.trim().strip_prefix("<!--")?.strip_suffix("-->")?.trim().to_string())
}

/// The identifier of a heading.
fn anchor(text: &str) -> String {
    let kept = text.trim().chars().filter(|letter| letter.is_alphanumeric() || " -_".contains(*letter));
    kept.map(|letter| if letter == ' ' { '-' } else { letter.to_ascii_lowercase() }).collect()
}

/// The second heading with the same text gets the suffix 1, and so on.
fn numbered(anchors: Vec<String>) -> Vec<String> {
    let mut seen = HashMap::<String, usize>::new();
    let number = |anchor: String| {
        let count = seen.entry(anchor.clone()).or_default();
        *count += 1;
        if *count == 1 { anchor } else { format!("{anchor}-{}", *count - 1) }
    };
    anchors.into_iter().map(number).collect()
}

#[test]
fn a_page_is_read_as_it_is_written() {
    let text = "# The `x` of it\n\nSave this as `a.toml`:\n\n```toml\nx = 1\n```\n\n<!-- not run: no -->\n```sh extra\nls\n```\n\
                \n## The x of it\n[there](b.md#c) ![picture](d.svg)\n";
    let page = Page::parse(text);
    assert_eq!(page.anchors, ["the-x-of-it", "the-x-of-it-1"]);
    assert_eq!(page.links, ["b.md#c", "d.svg"]);
    let [toml, sh] = &page.blocks[..] else { panic!("{page:?}") };
    assert_eq!((toml.language.as_str(), toml.text.as_str(), toml.file.as_deref()), ("toml", "x = 1\n", Some("a.toml")));
    assert_eq!((sh.language.as_str(), sh.comment.as_deref(), &sh.file), ("sh", Some("not run: no"), &None));
    assert_eq!(&text[sh.range.clone()], "```sh extra\nls\n```");
}
