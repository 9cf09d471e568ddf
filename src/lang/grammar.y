/* This is the grammar of CRT scripts: rules 1 to 32 of its definition, in levels of precedence,
   with the control statements and imports. Line ends mean nothing here. Where they matter the lexer
   says so by giving '(' and '[' another token. TreeBuilder builds the tree. check.cpp and the
   interpreter find later what is wrong with a tree that this grammar takes. */
%require "3.8"
%skeleton "lalr1.cc"
%define api.namespace {crt::lang}
%define api.parser.class {Grammar}
%define api.location.type {crt::lang::Span}
%define api.value.type variant
%define api.value.automove
%define api.token.constructor
%define parse.error custom
%define parse.lac full
%locations
%expect 0

%code requires {
#include <cstdint>
#include <string>
#include <vector>

#include "lang/nesting.hpp"
#include "lang/syntax.hpp"

namespace crt::lang {
class Lexer;
class TreeBuilder;
}
}

%parse-param { Lexer& lexer } { TreeBuilder& tree }
%lex-param { Lexer& lexer }

%code {
#include "lang/lexer.hpp"
#include "lang/tree_builder.hpp"

static crt::lang::Grammar::symbol_type yylex(crt::lang::Lexer& lexer) {
  return lexer.next();
}
}

/* The first token says what the text is, and is not in the text. */
%token START_SCRIPT START_EXPRESSION
%token END 0 "the end of the script"
/* No rule takes this token, so the parser says at it what it would take, see tolerance.hpp. */
%token CURSOR "the cursor"

%token <std::int64_t> INTEGER "a whole number"
%token <Number> FLOAT "a number"
%token <std::string> STRING "a string"
/* A string with values in it has these pieces around them. */
%token <std::string> STRING_START "a string up to a value" STRING_MIDDLE "a string between values"
%token <std::string> STRING_END "the end of a string"
%token <Symbol> IDENTIFIER "a name"
%token <Symbol> OBJECT_NAME "an object's name"

%token SETTINGS "Settings" SCENE "Scene" MACRO "Macro"
%token SCALE "scale" TRANSLATE "translate" ROTATE "rotate"
/* These are tokens of their own in few places, and names in all others. */
%token MATERIAL "material" ID "id" MATRIX "matrix" SHADOW "shadow" VISIBLE "visible"
%token MIRROR "mirror"
%token ELIF "elif" RETURN "return" AS "as"
%token TRUE "true" FALSE "false" WHILE "while" IF "if" ELSE "else" FOR "for" IN "in" IMPORT "import"

%token LEFT_BRACE "{" RIGHT_BRACE "}" RIGHT_PARENTHESIS ")" RIGHT_BRACKET "]"
/* First on its line each of these two begins an expression and never continues one. */
%token LEFT_PARENTHESIS "(" FIRST_PARENTHESIS "( first on its line"
%token LEFT_BRACKET "[" FIRST_BRACKET "[ first on its line"
/* This is a '<' before a modifier. */
%token MODIFIER_START "< before a modifier"
/* This is a '{' between a name and an attribute. */
%token DERIVING_BRACE "{ behind a name"
/* This is a '{' where a value is to be. */
%token DICTIONARY_BRACE "{ of a dictionary"

%token PLUS "+" MINUS "-" STAR "*" SLASH "/" PERCENT "%" CARET "^" NOT "!"
%token LESS "<" GREATER ">" LESS_EQUAL "<=" GREATER_EQUAL ">=" EQUAL "==" NOT_EQUAL "!="
%token POWER "**" ADD_ASSIGN "+=" SUBTRACT_ASSIGN "-=" MULTIPLY_ASSIGN "*=" DIVIDE_ASSIGN "/="
%token AND "&&" OR "||" QUESTION "?" COLON ":" ASSIGN "=" COMMA "," ARROW "->" DOT "."

/* There is no sign that ends a statement, so an expression is as long as it can be. Before a token
   that could either continue it or begin the next one, continuing has the higher precedence. */
%precedence END_OF_EXPRESSION
%precedence "(" "["
/* Operators of one nonterminal bind in this order. A nonterminal for each level would cost time, as
   it is reduced at each operand. */
%left "||"
%left "&&"
%left "+" "-" "^"
%left "*" "/" "%"

%nterm <Block> statements script_statements block
%nterm <Statement> statement script_statement while if for return settings scene import
%nterm <If> if_branches
%nterm <Expression*> expression conditional logical comparison arithmetic unary postfix
%nterm <Expression*> condition
%nterm <std::vector<const Expression*>> expressions items interpolation
%nterm <Call> arguments arguments_or_none
%nterm <std::vector<Clause>> clauses
%nterm <Clause> clause for_clause
%nterm <Expression*> bound
%nterm <std::vector<AttributeSyntax>> attributes
%nterm <AttributeSyntax> attribute entry
%nterm <std::vector<AttributeSyntax>> entries entries_or_none
%nterm <Parameters> parameters parameters_or_none
%nterm <AttributeSyntax> parameter
%nterm <std::vector<NamePlace>> names
%nterm <std::vector<Modifier>> modifiers
%nterm <Modifier> modifier
%nterm <ModifierKind> modifier_kind
%nterm <BinaryOperator> comparison_operator assignment_operator
/* This stands after each opening of something that can hold itself, and lives as long as that is
   open. */
%nterm <Nesting> nest

%%

/* The text is a script (rule 1), or one expression from elsewhere. */
text:
    START_SCRIPT script_statements           { tree.finish($2); }
  | START_EXPRESSION expression              { tree.finish($2); }

nest: %empty                                 { $$ = tree.enter(@0); }

/* ---- statements ---- */

script_statements:
    %empty                                   { $$ = Block(); }
  | script_statements script_statement       { $$ = tree.append($1, $2); }
  | script_statements error                  { $$ = $1; }

script_statement:
    statement                                { $$ = $1; }
  | settings                                 { $$ = $1; }
  | scene                                    { $$ = $1; }
  | import                                   { $$ = $1; }

statements:
    %empty                                   { $$ = Block(); }
  | statements statement                     { $$ = tree.append($1, $2); }
  | statements error                         { $$ = $1; }

statement:
    expression                               { $$ = tree.expression_statement(@$, $1); }
  | while                                    { $$ = $1; }
  | if                                       { $$ = $1; }
  | for                                      { $$ = $1; }
  | return                                   { $$ = $1; }

block: "{" nest statements "}"               { $$ = $3; $$.span = @$; }

settings: "Settings" "{" nest attributes "}" { $$ = tree.statement(@$, SettingsBlock{@1, $4}); }

scene: "Scene" block                         { $$ = tree.statement(@$, SceneBlock{@1, $2}); }

import:
    "import" STRING                          { $$ = tree.statement(@$, Import{@2, $2}); }
  | "import" STRING "as" IDENTIFIER
                                   { $$ = tree.statement(@$, Import{@2, $2, NamePlace{$4, @4}}); }

open: "(" | "( first on its line"

condition: open nest expression ")"          { $$ = $3; }

while: "while" condition block               { $$ = tree.statement(@$, While{@1, $2, $3}); }

for: "for" open names "in" expression ")" block
                                             { $$ = tree.statement(@$, For{@1, $3, $5, $7}); }

names:
    IDENTIFIER                               { $$.push_back({$1, @1}); }
  | names "," IDENTIFIER                     { $$ = $1; $$.push_back({$3, @3}); }

if:
    if_branches                              { $$ = tree.statement(@$, $1); }
  | if_branches "else" block
                                   { $$ = tree.statement(@$, tree.branch($1, nullptr, $3)); }

if_branches:
    "if" condition block                     { $$ = tree.branch(If(), $2, $3); }
  | if_branches "else" "if" condition block  { $$ = tree.branch($1, $4, $5); }
  | if_branches "elif" condition block       { $$ = tree.branch($1, $3, $4); }

return: "return" expression                  { $$ = tree.statement(@$, Return{@1, $2, {}}); }

/* ---- expressions, from the loosest level to the tightest ---- */

expression:
    conditional                              { $$ = $1; }
  | conditional "=" nest expression          { $$ = tree.assignment(@$, $1, @2, $4); }
  | conditional assignment_operator nest expression
                                             { $$ = tree.assignment(@$, $1, $2, @2, $4); }

assignment_operator:
    "+=" { $$ = BinaryOperator::add; }       | "-=" { $$ = BinaryOperator::subtract; }
  | "*=" { $$ = BinaryOperator::multiply; }  | "/=" { $$ = BinaryOperator::divide; }

conditional:
    logical                                  { $$ = $1; }
  | logical "?" nest expression ":" conditional
                                             { $$ = tree.expression(@$, Conditional{$1, $4, $6}); }

logical:
    comparison                               { $$ = $1; }
  | logical "||" logical           { $$ = tree.logical(LogicalOperator::disjunction, $1, $3); }
  | logical "&&" logical           { $$ = tree.logical(LogicalOperator::conjunction, $1, $3); }

comparison:
    arithmetic %prec END_OF_EXPRESSION       { $$ = $1; }
  | comparison comparison_operator arithmetic %prec END_OF_EXPRESSION
                                             { $$ = tree.chain($1, $2, @2, $3); }

comparison_operator:
    "<"  { $$ = BinaryOperator::less; }      | "<=" { $$ = BinaryOperator::less_or_equal; }
  | ">"  { $$ = BinaryOperator::greater; }   | ">=" { $$ = BinaryOperator::greater_or_equal; }
  | "==" { $$ = BinaryOperator::equal; }     | "!=" { $$ = BinaryOperator::not_equal; }

arithmetic:
    unary                                    { $$ = $1; }
  | arithmetic "+" arithmetic      { $$ = tree.chain($1, BinaryOperator::add, @2, $3); }
  | arithmetic "-" arithmetic      { $$ = tree.chain($1, BinaryOperator::subtract, @2, $3); }
  | arithmetic "^" arithmetic      { $$ = tree.chain($1, BinaryOperator::intersect, @2, $3); }
  | arithmetic "*" arithmetic      { $$ = tree.chain($1, BinaryOperator::multiply, @2, $3); }
  | arithmetic "/" arithmetic      { $$ = tree.chain($1, BinaryOperator::divide, @2, $3); }
  | arithmetic "%" arithmetic      { $$ = tree.chain($1, BinaryOperator::remainder, @2, $3); }

/* The exponent may have a sign, and the base none: -a ** b is -(a ** b). */
unary:
    postfix %prec END_OF_EXPRESSION          { $$ = $1; }
  | postfix "**" nest unary   { $$ = tree.chain($1, BinaryOperator::power, @2, $4); }
  | "+" nest unary
                                   { $$ = tree.expression(@$, Unary{UnaryOperator::plus, $3}); }
  | "-" nest unary
                                   { $$ = tree.expression(@$, Unary{UnaryOperator::minus, $3}); }
  | "!" nest unary                 { $$ = tree.expression(@$, Unary{UnaryOperator::negation, $3}); }

/* Primaries are here, too. A nonterminal for them would only be reduced to this one. */
postfix:
    INTEGER                                  { $$ = tree.literal(@$, $1); }
  | FLOAT                                    { $$ = tree.number(@$, $1); }
  | STRING                                   { $$ = tree.literal(@$, tree.string($1)); }
  | STRING_START nest interpolation STRING_END
                                   { $$ = tree.interpolation(@$, tree.text(@1, $1), $3,
                                                             tree.text(@4, $4)); }
  | "true"                                   { $$ = tree.literal(@$, true); }
  | "false"                                  { $$ = tree.literal(@$, false); }
  | IDENTIFIER                               { $$ = tree.expression(@$, Name{$1});
                                               /* Bison reports nothing for three tokens after
                                                  an error, but errors on the next line count. */
                                               if (tree.is_past_error(@1)) yyerrok; }
  | open nest expression ")"                 { $$ = $3; }
  | open_list nest items "]"                 { $$ = tree.expression(@$, ListLiteral{$3}); }
  | open_list nest expression clauses "]"    { $$ = tree.comprehension(@$, $3, $4); }
  | "{ of a dictionary" nest entries_or_none "}"
                                             { $$ = tree.dictionary(@$, $3); }
  | OBJECT_NAME "{" nest attributes "}"
                                   { $$ = tree.expression(@$, ObjectLiteral{{$1, @1}, $4}); }
  | IDENTIFIER "{ behind a name" nest attributes "}"
                                   { $$ = tree.expression(@$,
                                       DerivedMaterial{tree.expression(@1, Name{$1}), $4}); }
  | postfix "." IDENTIFIER "{ behind a name" nest attributes "}"
                                   { $$ = tree.expression(@$, DerivedMaterial{
                                       tree.member({@1.begin, @3.end}, $1, {$3, @3}), $6}); }
  | "Macro" open parameters_or_none ")" block
                                             { $$ = tree.macro(@$, $3, $5); }
  | postfix "[" nest expression "]"          { $$ = tree.expression(@$, Index{$1, $4}); }
  | postfix "[" nest bound ":" bound "]"     { $$ = tree.expression(@$, Slice{$1, $4, $6, @5}); }
  | postfix "." IDENTIFIER                   { $$ = tree.member(@$, $1, {$3, @3}); }
  | postfix "(" nest arguments_or_none ")"   { $$ = tree.call(@$, $1, $4); }
  | postfix "< before a modifier" nest modifiers ">"
                                             { $$ = tree.expression(@$, Modified{$1, $4}); }

modifiers:
    modifier                                 { $$.push_back($1); }
  | modifiers "," modifier                   { $$ = $1; $$.push_back($3); }

/* The operand is an arithmetic expression, so that '>' always closes the list. */
modifier:
    modifier_kind arithmetic                 { $$ = {.kind = $1, .operand = $2}; }
  | modifier IDENTIFIER arithmetic           { $$ = tree.modifier_with($1, @2, $3); }

modifier_kind:
    "scale"                                  { $$ = ModifierKind::scale; }
  | "translate"                              { $$ = ModifierKind::translate; }
  | "rotate"                                 { $$ = ModifierKind::rotate; }
  | "mirror"                                 { $$ = ModifierKind::mirror; }
  | "matrix"                                 { $$ = ModifierKind::matrix; }
  | "material"                               { $$ = ModifierKind::material; }
  | "id"                                     { $$ = ModifierKind::id; }
  | "shadow"                                 { $$ = ModifierKind::shadow; }
  | "visible"                                { $$ = ModifierKind::visible; }
  | IDENTIFIER                               { tree.unknown_modifier(@1);
                                               $$ = ModifierKind::scale; }

open_list: "[" | "[ first on its line"

/* A bound of a slice may be left out. */
bound:
    %empty                                   { $$ = nullptr; }
  | expression                               { $$ = $1; }

/* Values and pieces of the string between them take turns. */
interpolation:
    expression                               { $$.push_back($1); }
  | interpolation STRING_MIDDLE expression   { $$ = $1;
                                               $$.push_back(tree.text(@2, $2));
                                               $$.push_back($3); }

arguments_or_none:
    %empty                                   { }
  | arguments                                { $$ = $1; }

arguments:
    expression                               { $$ = tree.argument(Call(), $1); }
  | IDENTIFIER "->" expression               { $$ = tree.argument(Call(), {$1, @1}, $3); }
  | arguments "," expression                 { $$ = tree.argument($1, $3); }
  | arguments "," IDENTIFIER "->" expression { $$ = tree.argument($1, {$3, @3}, $5); }

expressions:
    expression                               { $$.push_back($1); }
  | expressions "," expression               { $$ = $1; $$.push_back($3); }

/* A comma may stand after the last item, so that lists with a line for each item look regular. */
items:
    %empty                                   { }
  | expressions                              { $$ = $1; }
  | expressions ","                          { $$ = $1; }

/* Later clauses run within the ones before. */
clauses:
    for_clause                               { $$.push_back($1); }
  | clauses clause                           { $$ = $1; $$.push_back($2); }

clause:
    for_clause                               { $$ = $1; }
  | "if" expression                          { $$ = {@1, {}, $2}; }

for_clause: "for" names "in" expression      { $$ = {@1, $2, $4}; }

/* The comma between two entries may be left out, as between the attributes of an object. */
entries_or_none:
    %empty                                   { }
  | entries                                  { $$ = $1; }
  | entries ","                              { $$ = $1; }

entries:
    entry                                    { $$.push_back($1); }
  | entries entry                            { $$ = $1; $$.push_back($2); }
  | entries "," entry                        { $$ = $1; $$.push_back($3); }

entry:
    attribute                                { $$ = $1; }
  | STRING "->" expression                   { $$ = {tree.key(@1, $1), $3}; }

attributes:
    %empty                                   { }
  | attributes attribute                     { $$ = $1; $$.push_back($2); }
  | attributes error                         { $$ = $1; }

attribute: IDENTIFIER "->" expression        { $$ = {{$1, @1}, $3}; }

parameters_or_none:
    %empty                                   { }
  | parameters                               { $$ = $1; }

parameters:
    parameter                                { $$ = tree.parameter(Parameters(), $1); }
  | parameters "," parameter                 { $$ = tree.parameter($1, $3); }

parameter:
    IDENTIFIER                               { $$ = {{$1, @1}, nullptr}; }
  | attribute                                { $$ = $1; }
  | IDENTIFIER "=" expression                { tree.refuse_default(@2);
                                               $$ = {{$1, @1}, $3}; }

%%

namespace crt::lang {

void Grammar::report_syntax_error(const context& context) const {
  const bool at_cursor = context.token() == symbol_kind::S_CURSOR;
  if (context.token() == symbol_kind::S_LEFT_BRACE ||
      context.token() == symbol_kind::S_DERIVING_BRACE)
    lexer.pass_over_block();
  if (!at_cursor && !tree.is_past_error(context.location())) return;
  // A place in the grammar expects fewer kinds of token than there are.
  symbol_kind_type expected[YYNTOKENS];
  const int count = context.expected_tokens(expected, YYNTOKENS);
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.emplace_back(symbol_name(expected[i]));
  if (at_cursor) return tree.expect_at_cursor(std::move(names));
  tree.syntax_error(context.location(), symbol_name(context.token()), names);
}

void Grammar::error(const Span& place, const std::string& message) {
  tree.syntax_error(place, message, {});
}

}  // namespace crt::lang
