#include "libio/model/column_names.hpp"

#include <algorithm>
#include <map>

namespace whirl::inline io {

namespace {

using Names = std::map<std::string, std::vector<ColumnName>, std::less<>>;

/// A column, and its names as plain_name has them, between blanks: English, then German, French,
/// Portuguese, Italian and Spanish.
struct Words {
  std::string_view column, words;
};

/// Of both ends, and of the left and the right one: "od", "odleft", "leftod", "odl".
constexpr Words diameters[] = {
    {"outer",
     "od outer outerdia odia outerdiam outerdiameter outsidedia outsidediameter outerd dout "
     "douter da daussen aussen aussendurchmesser diamext dext diametreext diametreexterieur "
     "diametroext diamexterno diametroexterno diametroesterno diametroexterior"},
    {"inner",
     "id inner innerdia idia innerdiam innerdiameter insidedia insidediameter innerd din "
     "dinner bore di dinnen innen innendurchmesser bohrung diamint dint diametreint "
     "diametreinterieur alesage diametroint diaminterno diametrointerno diametrointerior"}};

constexpr Words others[] = {
    {"length",
     "l len lg seglength segmentlength elementlength axiallength lange laenge longueur "
     "comprimento lunghezza longitud"},
    {"material", "mat matl werkstoff materiau materiale"},
    {"layer", "layerno schicht couche camada"},
    {"rayleigh_mass", "alpha"},
    {"rayleigh_stiffness", "beta"},
    {"station",
     "sta stano stationno stationnumber station# sta# stn no nr # n segment segmentno "
     "section sectionno row elem elemno element elementno elem# node nodeno knoten noeud "
     "estacao elemento"},
    {"position", "z at pos axialposition location axiallocation distance lage abscisse posicao"},
    // "mass" and "weight" are no names of it: some tables say with them what a segment weighs
    // itself
    {"added_mass",
     "addedweight addedwt addwt addedwgt addwgt addedw extmass extweight externalmass "
     "externalweight diskmass discmass lumpedmass pointmass zusatzmasse masseajoutee "
     "massaadicional"},
    {"polar_inertia",
     "ip jp addedip addip extip ipadded polar polarmoment polarmomentofinertia "
     "polarmassmoment polarmassmomentofinertia polaresmassentragheitsmoment inertiepolaire "
     "inerciapolar inerziapolare"},
    {"diametral_inertia",
     "it jt jd addedit addit extit itadded transverse transverseinertia transversemoment "
     "transversemomentofinertia transversemassmoment diametralmoment "
     "diametralmomentofinertia aquatorialestragheitsmoment inertiediametrale "
     "inerciadiametral inerciatransversal"},
    {"unbalance",
     "unbal imbalance unbalancemoment residualunbalance unwucht balourd desbalanceamento "
     "squilibrio desbalance"},
    {"unbalance_angle", "unbalangle unbalancephase unbalphase imbalanceangle unwuchtwinkel"},
    {"bearing", "brg bearings bearingname lager palier mancal cuscinetto cojinete"},
    {"seal", "seals sealname dichtung selo tenuta sello"},
    {"probe", "probes probename sensor sensors messstelle capteur sonda"},
    {"channel", "ch chan channelno channelname kanal voie canal canale"},
    {"gain",
     "sensitivity scale scalefactor empfindlichkeit verstarkung sensibilite sensibilidade "
     "sensibilita sensibilidad"},
    {"full_scale", "fullscale fs range vollausschlag"},
    {"unit", "units einheit unite unidade unita unidad"},
    {"name", "component part description label bezeichnung benennung designation descricao"},
    {"deflection", "bow"},
    {"angle", "phase"},
    {"speed",
     "rotorspeed shaftspeed spinspeed spin runningspeed operatingspeed rotationalspeed "
     "rotationspeed rotatingspeed drehzahl vitesse vitessederotation regime velocidade "
     "rotacao velocita velocidad"},
    {"whirl",
     "freq frequency whirlfreq whirlfrequency whirlspeed whirlingspeed whirlingfrequency "
     "excitation excfreq excitationfreq excitationfrequency precessionfrequency "
     "vibrationfrequency frequenz wirbelfrequenz frequence frequencia frequenza frecuencia"}};

/// Parts of complex numbers; of entries of matrices with their row and column behind them.
constexpr Words complex_parts[] = {{"real", "re realpart"},
                                   {"imaginary", "im imag imaginarypart"},
                                   {"magnitude", "mag abs modulus amplitude"},
                                   {"angle", "phase arg"}};

/// Names that say the unit of their numbers.
struct WordWithUnit {
  std::string_view word, column, unit;
};
constexpr WordWithUnit with_units[] = {
    {"rpm", "speed", "rpm"}, {"n", "speed", "rpm"}, {"hz", "whirl", "Hz"}, {"cpm", "whirl", "rpm"}};

/// Calls f(word) for all words between blanks.
template <class F>
void for_each_word(std::string_view words, F f) {
  for (std::size_t start = 0; start < words.size();) {
    const std::size_t end = std::min(words.find(' ', start), words.size());
    f(std::string(words.substr(start, end - start)));
    start = end + 1;
  }
}

void add_diameters(Names& names, const Words& side) {
  const std::string column(side.column);
  for_each_word(side.words, [&](const std::string& word) {
    names[word].push_back({column + "_diameter", ""});
    for (const std::string end : {"left", "right"}) {
      for (const std::string& name : {word + end, end + word, word + end[0]}) {
        names[name].push_back({column + "_" + end, ""});
      }
    }
  });
}

/// Coefficients: k11 is kxx; b is another letter for damping.
void add_coefficients(Names& names) {
  for (const std::string group : {"k", "c", "m", "kt", "ct", "b"}) {
    for (const int i : {0, 1}) {
      for (const int j : {0, 1}) {
        const ColumnName column{(group == "b" ? "c" : group) + "xy"[i] + "xy"[j], ""};
        names[group + "12"[i] + "12"[j]].push_back(column);
        if (group == "b") names[group + "xy"[i] + "xy"[j]].push_back(column);
      }
    }
  }
}

void add_parts(Names& names) {
  for (const Words& part : complex_parts) {
    for_each_word(part.words, [&](const std::string& word) {
      if (part.column != "angle") names[word].push_back({std::string(part.column), ""});
      for (const char row : {'1', '2', '3', '4'}) {
        for (const char column : {'1', '2', '3', '4'}) {
          names[word + row + column].push_back({std::string(part.column) + row + column, ""});
        }
      }
    });
  }
}

Names all_names() {
  Names names;
  for (const WordWithUnit& word : with_units) {
    names[std::string(word.word)].push_back({std::string(word.column), word.unit});
  }
  for (const Words& side : diameters) add_diameters(names, side);
  add_coefficients(names);
  add_parts(names);
  for (const Words& other : others) {
    for_each_word(other.words, [&](const std::string& word) {
      names[word].push_back({std::string(other.column), ""});
    });
  }
  return names;
}

}  // namespace

const std::vector<ColumnName>& columns_called(std::string_view plain) {
  static const Names names = all_names();
  static const std::vector<ColumnName> none;
  const auto found = names.find(plain);
  return found == names.end() ? none : found->second;
}

bool names_remarks(std::string_view plain) {
  static constexpr std::string_view words[] = {
      "remark",     "remarks",     "comment",       "comments",    "note",        "notes",
      "bemerkung",  "bemerkungen", "kommentar",     "kommentare",  "remarque",    "remarques",
      "observacao", "observacoes", "observaciones", "commentaire", "osservazioni"};
  return std::find(std::begin(words), std::end(words), plain) != std::end(words);
}

}  // namespace whirl::inline io
