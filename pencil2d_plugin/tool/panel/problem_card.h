// A card with what went wrong and what to do. Details can be copied.
#pragma once

#include "user_error.h"

#include <QFrame>
#include <QLabel>
#include <QToolButton>

namespace lampblack
{

/// Hidden until there is a problem. Shows the newest one. A problem that ends by itself takes its card with
/// it: see settle().
class ProblemCard : public QFrame
{
    Q_OBJECT

public:
    explicit ProblemCard(QWidget* parent = nullptr);

    void showError(const UserError& error);
    /// Hide the card if it shows a problem of this kind, which is over.
    void settle(UserError::Kind kind);
    const UserError& error() const { return mError; }
    /// The text that "Copy details" copies.
    QString report() const;

Q_SIGNALS:
    void retryRequested(); ///< start the worker again

private:
    UserError mError;
    QLabel* mWhat;
    QLabel* mRemedy;
    QToolButton* mRetry;
    QToolButton* mCopy;
};

} // namespace lampblack
