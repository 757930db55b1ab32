// Types of Qt in the scene, and the text that stands for them in JSON.
#pragma once

#include <QColor>
#include <QString>

namespace lampblack
{

/// A colour is "#rrggbb".
template <class Fields, class... Rule>
void text(Fields& fields, const char* name, QColor& value, const Rule&... rule)
{
    QString text = value.name();
    fields.text(name, text, rule...);
    value = QColor(text);
}

} // namespace lampblack
