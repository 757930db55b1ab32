#include "tool/panel/section.h"

namespace lampblack
{

Section::Section(const QString& name, const QString& title, bool open, QWidget* parent)
    : QWidget(parent), mHeading(new QToolButton(this)), mContent(new QWidget(this)),
      mBody(new QVBoxLayout(mContent))
{
    mHeading->setObjectName(name);
    mHeading->setText(title);
    mHeading->setCheckable(true);
    mHeading->setChecked(open);
    mHeading->setAutoRaise(true);
    mHeading->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    mHeading->setIconSize(QSize(10, 10));
    mHeading->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    mHeading->setFocusPolicy(Qt::TabFocus);
    QFont bold = mHeading->font();
    bold.setBold(true);
    mHeading->setFont(bold);
    mBody->setContentsMargins(6, 0, 2, 4);
    mBody->setSpacing(3);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(2);
    column->addWidget(mHeading);
    column->addWidget(mContent);
    const auto fold = [this](bool opened)
    {
        mHeading->setArrowType(opened ? Qt::DownArrow : Qt::RightArrow);
        mContent->setVisible(opened);
    };
    connect(mHeading, &QToolButton::toggled, this, fold);
    fold(open);
}

} // namespace lampblack
