// A card with what went wrong and what to do. Details can be copied.
#pragma once

#include "user_error.h"

#include <QFrame>
#include <QLabel>

namespace lampblack
{

/// Hidden until there is a problem. Shows the newest one.
class ProblemCard : public QFrame
{
    Q_OBJECT

public:
    explicit ProblemCard(QWidget* parent = nullptr);

    void showError(const UserError& error);
    const UserError& error() const { return mError; }
    /// The text that "Copy details" copies.
    QString report() const;

private:
    UserError mError;
    QLabel* mWhat;
    QLabel* mRemedy;
};

} // namespace lampblack
