#include "tool/panel/problem_card.h"

#include <QApplication>
#include <QClipboard>
#include <QHBoxLayout>
#include <QVBoxLayout>

namespace lampblack
{

ProblemCard::ProblemCard(QWidget* parent)
    : QFrame(parent), mWhat(new QLabel(this)), mRemedy(new QLabel(this)), mRetry(new QToolButton(this)),
      mCopy(new QToolButton(this))
{
    setObjectName(QStringLiteral("lampblack.panel.problem"));
    setFrameShape(QFrame::StyledPanel);
    // Colours of its own, readable in light and dark themes.
    QPalette card = palette();
    card.setColor(QPalette::Window, QColor(255, 240, 214));
    card.setColor(QPalette::WindowText, QColor(64, 40, 8));
    card.setColor(QPalette::Button, QColor(255, 240, 214));
    card.setColor(QPalette::ButtonText, QColor(64, 40, 8));
    setPalette(card);
    setAutoFillBackground(true);
    const auto prepare = [](QLabel* label, const QString& name)
    {
        label->setObjectName(name);
        label->setWordWrap(true);
        label->setTextFormat(Qt::PlainText);
        label->setTextInteractionFlags(Qt::TextSelectableByMouse);
        // A long path must not widen the dock.
        label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    };
    prepare(mWhat, QStringLiteral("lampblack.panel.problem.what"));
    prepare(mRemedy, QStringLiteral("lampblack.panel.problem.remedy"));
    QFont bold = mWhat->font();
    bold.setBold(true);
    mWhat->setFont(bold);
    auto* dismiss = new QToolButton(this);
    auto* buttons = new QHBoxLayout;
    const auto addButton = [buttons](QToolButton* button, const QString& name, const QString& text)
    {
        button->setObjectName(QStringLiteral("lampblack.panel.problem.") + name);
        button->setText(text);
        button->setAutoRaise(true);
        buttons->addWidget(button);
    };
    addButton(mRetry, QStringLiteral("retry"), tr("Try Again"));
    addButton(mCopy, QStringLiteral("copy"), tr("Copy Details"));
    buttons->addStretch(1);
    addButton(dismiss, QStringLiteral("dismiss"), tr("Dismiss"));
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(8, 6, 4, 2);
    column->setSpacing(3);
    column->addWidget(mWhat);
    column->addWidget(mRemedy);
    column->addLayout(buttons);
    connect(mRetry, &QToolButton::clicked, this, &QWidget::hide);
    connect(mRetry, &QToolButton::clicked, this, &ProblemCard::retryRequested);
    connect(mCopy, &QToolButton::clicked, this, [this] { QApplication::clipboard()->setText(report()); });
    connect(dismiss, &QToolButton::clicked, this, &QWidget::hide);
    hide();
}

void ProblemCard::showError(const UserError& error)
{
    mError = error;
    mWhat->setText(error.what);
    mRemedy->setText(error.remedy);
    mRemedy->setVisible(!error.remedy.isEmpty());
    mRetry->setVisible(error.kind == UserError::Kind::NoWorker ||
                       error.kind == UserError::Kind::NoOtherComputer);
    // An empty drawing is no fault, so there is nothing to report.
    mCopy->setVisible(error.kind != UserError::Kind::NothingDrawn);
    show();
}

void ProblemCard::settle(UserError::Kind kind)
{
    if (mError.kind == kind)
        hide();
}

QString ProblemCard::report() const
{
    QStringList parts{mError.what, mError.remedy, mError.details};
    parts.removeAll(QString());
    return parts.join(QLatin1Char('\n')) +
           QStringLiteral("\n(Lampblack %1)").arg(QStringLiteral(LAMPBLACK_VERSION));
}

} // namespace lampblack
