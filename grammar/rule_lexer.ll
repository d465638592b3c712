/* SPDX-License-Identifier: MIT
   The tokens of rule files. Patterns only: every action is one call to the Scanner, which knows
   the place of what was matched. The scanner has no state of its own but for its place. */
%option reentrant noyywrap nodefault never-interactive 8bit noinput nounput
%option prefix="gmsim_rule_" extra-type="gmsim::syntax::Scanner*"

%top{
#include <algorithm>
#include <string>

#include "support/check.h"
#include "syntax/scanner.h"
}

%{
#define YY_DECL static void scan_all(yyscan_t yyscanner)
#define YY_USER_ACTION yyextra->advance(yyleng);
#define yyterminate() return
#define YY_FATAL_ERROR(message) gmsim::support::internal_error("rule_lexer.ll", 0, message)

using Token = gmsim::syntax::RuleParser::token;
YY_DECL;
%}

DIGITS    [0-9]+
EXPONENT  [eE][+-]?[0-9]+
WORD      [A-Za-z_][A-Za-z0-9_]*

%%

[ \t\r\f\v]+   { }
\n             { yyextra->end_line(); }

"///"([^/\n][^\n]*)?                 { yyextra->doc_line(); }
"//"[^\n]*                           { yyextra->comment(); }
"/*"([^*]|"*"+[^*/])*"*"+"/"         { yyextra->comment(); }
"/*"([^*]|"*"+[^*/])*"*"*            { yyextra->open_comment(); }

"n"       { yyextra->add(Token::TOP); }
"on"      { yyextra->add(Token::ON); }
"in"      { yyextra->add(Token::IN); }
"where"   { yyextra->add(Token::WHERE); }
"if"      { yyextra->add(Token::IF); }
"then"    { yyextra->add(Token::THEN); }
"else"    { yyextra->add(Token::ELSE); }
"and"     { yyextra->add(Token::AND); }
"or"      { yyextra->add(Token::OR); }
"not"     { yyextra->add(Token::NOT); }
"true"    { yyextra->add(Token::TRUE); }
"false"   { yyextra->add(Token::FALSE); }
"let"     { yyextra->add(Token::LET); }
"param"   { yyextra->add(Token::PARAM); }
"for"     { yyextra->add(Token::FOR); }
"apply"   { yyextra->add(Token::APPLY); }
"import"  { yyextra->add(Token::IMPORT); }

"orbit"        { yyextra->add(Token::ORBIT); }
"embedding"    { yyextra->add(Token::EMBEDDING); }
"derived"      { yyextra->add(Token::DERIVED); }
"function"     { yyextra->add(Token::FUNCTION); }
"pattern"      { yyextra->add(Token::PATTERN); }
"rule"         { yyextra->add(Token::RULE); }
"interaction"  { yyextra->add(Token::INTERACTION); }
"external"     { yyextra->add(Token::EXTERNAL); }
"family"       { yyextra->add(Token::FAMILY); }
"criterion"    { yyextra->add(Token::CRITERION); }
"operation"    { yyextra->add(Token::OPERATION); }
"dimension"    { yyextra->add(Token::DIMENSION); }
"optional"     { yyextra->add(Token::OPTIONAL); }
"intensive"    { yyextra->add(Token::INTENSIVE); }
"extensive"    { yyextra->add(Token::EXTENSIVE); }
"split"        { yyextra->add(Token::SPLIT); }
"merge"        { yyextra->add(Token::MERGE); }
"left"         { yyextra->add(Token::LEFT); }
"right"        { yyextra->add(Token::RIGHT); }
"match"        { yyextra->add(Token::MATCH); }
"energy"       { yyextra->add(Token::ENERGY); }
"force"        { yyextra->add(Token::FORCE); }
"first"        { yyextra->add(Token::FIRST); }
"result"       { yyextra->add(Token::RESULT); }
"value"        { yyextra->add(Token::VALUE); }
"of"           { yyextra->add(Token::OF); }
"all"          { yyextra->add(Token::ALL); }

"_"     { yyextra->add(Token::BLANK); }
{WORD}  { yyextra->add(Token::NAME); }

{DIGITS}                                       { yyextra->add(Token::INTEGER); }
{DIGITS}"."{DIGITS}{EXPONENT}?                 { yyextra->add(Token::REAL); }
{DIGITS}{EXPONENT}                             { yyextra->add(Token::REAL); }
{DIGITS}("."{DIGITS})?{WORD}                   { yyextra->bad_number(); }

\"([^"\\\n]|\\["\\])*\"   { yyextra->string(); }
\"([^"\\\n]|\\.)*\"       { yyextra->bad_string(); }
\"([^"\\\n]|\\.)*         { yyextra->open_string(); }

"{"   { yyextra->add(Token::LBRACE); }
"}"   { yyextra->add(Token::RBRACE); }
"("   { yyextra->add(Token::LPAREN); }
")"   { yyextra->add(Token::RPAREN); }
"["   { yyextra->add(Token::LBRACKET); }
"]"   { yyextra->add(Token::RBRACKET); }
";"   { yyextra->add(Token::SEMICOLON); }
","   { yyextra->add(Token::COMMA); }
":"   { yyextra->add(Token::COLON); }
"="   { yyextra->add(Token::ASSIGN); }
"."   { yyextra->add(Token::DOT); }
".."  { yyextra->add(Token::RANGE); }
"@"   { yyextra->add(Token::AT); }
"+"   { yyextra->add(Token::PLUS); }
"-"   { yyextra->add(Token::MINUS); }
"*"   { yyextra->add(Token::TIMES); }
"/"   { yyextra->add(Token::DIVIDE); }
"^"   { yyextra->add(Token::POWER); }
"<"   { yyextra->add(Token::LESS); }
"<="  { yyextra->add(Token::LESS_EQUAL); }
">"   { yyextra->add(Token::GREATER); }
">="  { yyextra->add(Token::GREATER_EQUAL); }
"=="  { yyextra->add(Token::EQUAL); }
"!="  { yyextra->add(Token::NOT_EQUAL); }

"&&"|"||"                { yyextra->bad_character(); }
[^\x09-\x0d\x20-\x7e]+   { yyextra->bad_character(); }
.                        { yyextra->bad_character(); }

%%

namespace gmsim::syntax {

void Scanner::run(std::string_view text) {
  // At each zero byte flex goes back to the beginning of the token, which takes quadratic time. No
  // pattern tells zero from another control character, and messages are made from the text itself.
  std::string buffer(text);
  std::replace(buffer.begin(), buffer.end(), '\0', '\1');
  buffer.append(2, YY_END_OF_BUFFER_CHAR);
  yyscan_t state = nullptr;
  yylex_init_extra(this, &state);
  yy_scan_buffer(buffer.data(), buffer.size(), state);
  scan_all(state);
  yylex_destroy(state);
}

}  // namespace gmsim::syntax
