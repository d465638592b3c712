// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

/// Well-known operations as rule schemes, in the notation of scheme_text.h.
namespace gmsim::tests {

struct NamedScheme {
  const char* name;
  int dimension;
  const char* text;
};

/// Operations that keep every map a map.
inline const std::vector<NamedScheme>& sound_schemes() {
  static const std::vector<NamedScheme> schemes{
      {"new dart", 1, "=> a<> | a-0-a a-1-a"},
      {"1-sew", 1, "a*<> b*<> | a-1-a b-1-b => a<> b<> | a-1-b"},
      {"segment subdivision", 1, "a*<0> => a<_> m<1> | a-0-m"},
      {"2-sew", 2, "a*<0> b*<0> | a-2-a b-2-b => a<0> b<0> | a-2-b"},
      {"2-unsew", 2, "a*<0> b<0> | a-2-b => a<0> b<0> | a-2-a b-2-b"},
      {"2-unsew, explicit", 2,
       "a*<> b<> c<> d<> | a-0-b d-0-c a-2-d b-2-c => "
       "a<> b<> c<> d<> | a-0-b d-0-c a-2-a b-2-b c-2-c d-2-d"},
      {"3-sew", 3, "a*<0 1> b*<0 1> | a-3-a b-3-b => a<0 1> b<0 1> | a-3-b"},
      {"3-unsew", 3, "a*<0 1> b<0 1> | a-3-b => a<0 1> b<0 1> | a-3-a b-3-b"},
      {"edge subdivision", 2, "a*<0 2> => a<_ 2> m<1 2> | a-0-m"},
      {"edge subdivision", 3, "a*<0 2 3> => a<_ 2 3> m<1 2 3> | a-0-m"},
      {"face cone", 2, "a*<0 1> => a<0 _> b<_ 2> c<1 2> | a-1-b b-0-c"},
      {"face cone", 3, "a*<0 1 3> => a<0 _ 3> b<_ 2 3> c<1 2 3> | a-1-b b-0-c"},
      {"volume cone", 3, "a*<0 1 2> => a<0 1 _> b<0 _ 3> c<_ 2 3> d<1 2 3> | a-2-b b-1-c c-0-d"},
      {"dual", 2, "a*<0 1 2> => a<2 1 0>"},
      {"dual", 3, "a*<0 1 2 3> => a<3 2 1 0>"},
      {"free edge to quad", 2,
       "a*<0> | a-2-a => a<0> b<0> c<_> d<_> e<0> | a-2-b b-1-c c-0-d d-1-e c-2-c d-2-d e-2-e"},
      {"face to prism", 3,
       "a*<0 1> | a-2-a a-3-a => a<0 1> b<0 _> c<_ 2> d<_ 2> e<0 _> f<0 1> | "
       "a-2-b b-1-c c-0-d d-1-e e-2-f a-3-a b-3-b c-3-c d-3-d e-3-e f-3-f"},
      {"quad subdivision", 2,
       "a*<0 1 2> => a<_ 1 2> b<_ _ 2> c<2 _ _> d<2 1 _> | a-0-b b-1-c c-0-d"},
      {"corner cut", 2, "a*<0 1 2> => a<_ 1 2> b<_ _ 2> c<_ 0 _> d<1 0 _> | a-0-b b-1-c c-2-d"},
      {"hexahedral subdivision", 3,
       "a*<0 1 2 3> => a<_ 1 2 3> b<_ _ 2 3> c<_ _ _ 3> d<_ 1 _ 3> e<3 _ 1 _> f<3 _ _ _> "
       "g<3 2 _ _> h<3 2 1 _> | a-0-b b-1-c c-0-d c-2-e d-2-f e-0-f f-1-g g-0-h"},
      {"remove isolated face", 2, "a*<0 1> | a-2-a =>"},
      {"remove isolated volume", 3, "a*<0 1 2> | a-3-a =>"},
      {"remove sewn face", 2, "a*<0 1> b<0 _> | a-2-b => b<0 _> | b-2-b"},
      {"remove sewn volume", 3, "a*<0 1 2> b<0 1 _> | a-3-b => b<0 1 _> | b-3-b"},
      {"edge removal", 2, "a*<0 2> b<_ _> | a-1-b => b<_ 1>"},
      {"edge removal, free faces", 3, "a*<0 2> b<_ _> | a-1-b a-3-a b-3-b => b<_ 1> | b-3-b"},
      {"edge removal, two volumes", 3,
       "a*<0 2> b<_ _> c<0 2> d<_ _> | a-1-b a-3-c b-3-d c-1-d => b<_ 1> d<_ 1> | b-3-d"},
      {"quad split", 2,
       "a*<> b<> c<> d<> e<> f<> g<> h<> | a-0-b b-1-c c-0-d d-1-e e-0-f f-1-g g-0-h h-1-a => "
       "a<> b<> c<> d<> e<> f<> g<> h<> p<> q<> r<> s<> | a-0-b b-1-c c-0-d d-1-p p-0-q q-1-a "
       "e-0-f f-1-g g-0-h h-1-r r-0-s s-1-e p-2-s q-2-r"},
      {"another dart in the place of one", 2,
       "a*<> t<> y<> s<> | a-2-t t-0-y t-1-s => a<> y<> s<> z<> | a-2-z z-0-y z-1-s"},
      {"edge flip between triangles", 2,
       "a*<> b<> c<> d<> e<> f<> p<> q<> r<> s<> t<> u<> | "
       "a-0-b b-1-c c-0-d d-1-e e-0-f f-1-a p-0-q q-1-r r-0-s s-1-t t-0-u u-1-p a-2-q b-2-p => "
       "a<> b<> c<> d<> e<> f<> p<> q<> r<> s<> t<> u<> | "
       "a-0-b c-0-d e-0-f p-0-q r-0-s t-0-u a-2-q b-2-p "
       "a-1-d c-1-u t-1-b q-1-s r-1-f e-1-p"}};
  return schemes;
}

/// Operations that look right and break some maps.
inline const std::vector<NamedScheme>& unsound_schemes() {
  static const std::vector<NamedScheme> schemes{
      {"2-unsew of one pair of darts", 2, "a*<> d<> | a-2-d => a<> d<> | a-2-a d-2-d"},
      {"edge removal without looking at the volumes", 3, "a*<0 2 3> b<_ _ 3> | a-1-b => b<_ 1 3>"},
      {"2-sew of darts", 2, "a*<> b*<> | a-2-a b-2-b => a<> b<> | a-2-b"},
      {"3-unsew of an edge of a face", 3, "a*<0> b<0> | a-3-b => a<0> b<0> | a-3-a b-3-b"},
      {"swap of two links that do not commute", 2, "a*<0 1> => a<0 2>"},
      {"dual of a face", 2, "a*<0 1> => a<1 0>"}};
  return schemes;
}

}  // namespace gmsim::tests
