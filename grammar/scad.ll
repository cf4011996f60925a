/* The tokens of OpenSCAD 2021.01, and the shifts of later versions.

   Names may begin with a digit, numbers may begin or end with a point, and
   bytes outside ASCII may stand only in strings and comments, the no-break
   space excepted. `include <file>` is no token: it switches to that file
   wherever a blank may stand, and back at its end.

   Texts are fed in pieces, so no copy of a file is made; the reader counts
   bytes and knows from that which piece of which file a token is. */

%option reentrant
%option prefix="scad"
%option extra-type="lamina::detail::Reader*"
%option noyywrap nounput noinput never-interactive batch
%option 8bit full

%top{
#include <new>

#include "parser/detail/reader.h"
#include "scad_grammar.h"
}

%{
using lamina::SourceRange;
using lamina::detail::Reader;

#define YY_DECL \
  int scadlex(SCADSTYPE* value, SourceRange* range, void* yyscanner)
YY_DECL;

// Flex reads a token that outgrows its buffer anew with each refill; by its
// own limit of 8 KiB a refill a comment of 50 MB would take minutes.
#define YY_READ_BUF_SIZE (1 << 28)

#define YY_INPUT(buffer, result, most) \
  (result) = static_cast<int>(yyextra->feed(buffer, most))

// By itself Flex would end the program, with status 2.
#define YY_FATAL_ERROR(message) throw std::bad_alloc()

#define YY_USER_ACTION *range = yyextra->take(static_cast<std::uint32_t>(yyleng));

// What happens at the end of a file in the middle of a string, a comment or a
// file name: an error, reported here, and then the token that says so.
#define LAMINA_UNTERMINATED(report, what) \
  do {                                    \
    yyextra->report(what);                \
    *range = yyextra->place();            \
    BEGIN(INITIAL);                       \
    return TOKEN_SCADerror;               \
  } while (false)
%}

%x IN_COMMENT IN_STRING IN_INCLUDE IN_USE

DIGIT     [0-9]
EXPONENT  [Ee][+-]?{DIGIT}+
HEX       [0-9a-fA-F]
TAIL      [\x80-\xbf]
UTF8      [\xc2-\xdf]{TAIL}|[\xe0-\xef]{TAIL}{2}|[\xf0-\xf4]{TAIL}{3}
BLANKS    [ \t\r\n]*

%%

[ \t\r\n]+              { }
"//"[^\n]*              { }

"/*"                    { yyextra->begin_token(*range); BEGIN(IN_COMMENT); }
<IN_COMMENT>{
"*/"                    { BEGIN(INITIAL); }
[^*]+                   { }
"*"                     { }
<<EOF>>                 { LAMINA_UNTERMINATED(report_unterminated, "comment"); }
}

 /* The path stands up to '>' on one line. Of several lines the last counts,
    as OpenSCAD reads it. */
include{BLANKS}"<"      { yyextra->begin_token(*range); BEGIN(IN_INCLUDE); }
<IN_INCLUDE>{
[^\t\r\n>]+             { yyextra->set_file_name({yytext, static_cast<std::size_t>(yyleng)}); }
\t+                     { }
[\r\n]                  { yyextra->warn_in_2026("new lines in 'include<>'-statement is not defined - behavior may change in the future"); }
">"                     {
                          BEGIN(INITIAL);
                          if (yyextra->open_include()) {
                            yypush_buffer_state(
                                yy_create_buffer(nullptr, YY_BUF_SIZE, yyscanner), yyscanner);
                          }
                        }
<<EOF>>                 { LAMINA_UNTERMINATED(report_unterminated_name, "include statement"); }
}

use{BLANKS}"<"          { yyextra->begin_token(*range); BEGIN(IN_USE); }
<IN_USE>{
[^\t\r\n>]+             { yyextra->set_file_name({yytext, static_cast<std::size_t>(yyleng)}); }
\t+                     { }
[\r\n]                  { yyextra->warn_in_2026("new lines 'use<>'-statement is not defined - behavior may change in the future"); }
">"                     {
                          BEGIN(INITIAL);
                          *range = yyextra->whole_token();
                          value->use = yyextra->find_use(*range);
                          return TOKEN_USE;
                        }
<<EOF>>                 { LAMINA_UNTERMINATED(report_unterminated_name, "use statement"); }
}

 /* Most strings hold no escape and are views into the text. */
\"[^\\\n\"]*\"          { value->text = yyextra->plain_string(*range); return TOKEN_STRING; }

 /* An unknown escape loses its backslash, a line break vanishes. */
\"                      { yyextra->begin_token(*range); BEGIN(IN_STRING); }
<IN_STRING>{
\\n                     { yyextra->add_to_string("\n"); }
\\t                     { yyextra->add_to_string("\t"); }
\\r                     { yyextra->add_to_string("\r"); }
\\\\                    { yyextra->add_to_string("\\"); }
\\\"                    { yyextra->add_to_string("\""); }
\\x[0-7]{HEX}           |
\\u{HEX}{4}             |
\\U{HEX}{6}             { yyextra->add_code_point(yytext + 2); }
\\                      { yyextra->warn_in_2026("Undefined escape sequence"); }
\n                      { yyextra->break_string(*range); }
[^\\\n\"]+              { yyextra->add_to_string({yytext, static_cast<std::size_t>(yyleng)}); }
\"                      {
                          BEGIN(INITIAL);
                          *range = yyextra->whole_token();
                          value->text = yyextra->take_string();
                          return TOKEN_STRING;
                        }
<<EOF>>                 { LAMINA_UNTERMINATED(report_unterminated, "string"); }
}

<<EOF>>                 {
                          if (!yyextra->close_include()) {
                            *range = yyextra->place();
                            return TOKEN_EOF;
                          }
                          yypop_buffer_state(yyscanner);
                        }

"\x03"                  { return TOKEN_END_OF_FILE; }

module                  { return TOKEN_MODULE; }
function                { return TOKEN_FUNCTION; }
if                      { return TOKEN_IF; }
else                    { return TOKEN_ELSE; }
let                     { return TOKEN_LET; }
assert                  { return TOKEN_ASSERT; }
echo                    { return TOKEN_ECHO; }
for                     { return TOKEN_FOR; }
each                    { return TOKEN_EACH; }
true                    { return TOKEN_TRUE; }
false                   { return TOKEN_FALSE; }
undef                   { return TOKEN_UNDEF; }

 /* No-break spaces, which editors like to leave behind, whole or halved, and
    byte order marks. */
[\xc2\xa0]+             { }
\xef\xbb\xbf            { }
({UTF8})+               { return TOKEN_INVALID; }

{DIGIT}+{EXPONENT}?            |
{DIGIT}*\.{DIGIT}+{EXPONENT}?  |
{DIGIT}+\.{DIGIT}*{EXPONENT}?  {
                          return yyextra->read_number(yytext, yytext + yyleng, value->number)
                                     ? TOKEN_NUMBER : TOKEN_INVALID;
                        }
 /* 0xff is a name too, as in 2021.01; where nothing has that name, it is a
    number (csg/eval/resolve/prefixed_literal.h). */
0x[0-9a-fA-F]+|0b[01]+  { return TOKEN_NAME; }
"$"?[a-zA-Z0-9_]+       { yyextra->note_name(*range); return TOKEN_NAME; }

"<="                    { return TOKEN_LESS_EQUAL; }
">="                    { return TOKEN_GREATER_EQUAL; }
"=="                    { return TOKEN_EQUAL; }
"!="                    { return TOKEN_NOT_EQUAL; }
"&&"                    { return TOKEN_AND; }
"||"                    { return TOKEN_OR; }
"<<"                    { return TOKEN_SHIFT_LEFT; }
">>"                    { return TOKEN_SHIFT_RIGHT; }

[(\[{]                  { yyextra->open_bracket(*range); return yytext[0]; }
[)\]}]                  { yyextra->close_bracket(); return yytext[0]; }
[\x21-\x7e]             { return yytext[0]; }
.                       { return TOKEN_INVALID; }
