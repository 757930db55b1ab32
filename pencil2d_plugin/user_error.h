// What a person is told when something goes wrong.
#pragma once

#include <QMetaType>
#include <QString>

namespace lampblack
{

/// What happened, what to do about it, and details worth copying into a report.
struct UserError
{
    QString what;
    QString remedy;
    QString details;
};

} // namespace lampblack

Q_DECLARE_METATYPE(lampblack::UserError)
